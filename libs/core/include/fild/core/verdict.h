// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/pair_evidence.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Number of a camera frame in the order of the recording, from 0. */
enum class FrameId : std::uint64_t
{
};

constexpr std::uint64_t to_index(FrameId id)
{
    return static_cast<std::uint64_t>(id);
}

/** Why a frame is no accepted loop closure; the word in the `rejection` column of frames.csv is the
 *  enumerator's name. The four after `none` mean that the frame could not be used at
 *  all: such a frame is passed over, and neither makes nor breaks a row of consistent frames. */
enum class Rejection
{
    none,  ///< accepted: a loop closure
    missing_image,  ///< the externally stored image is not there, or is no image
    image_size_changed,  ///< cannot be scaled to this camera's first image
    repeated_timestamp,  ///< recorded twice: time stamp and image of the camera frame before
    unsupported_image,  ///< neither grey nor colour of 8 or 16 bit
    too_early,  ///< the index is still empty: nothing is older than the delay (psi)
    no_candidate,  ///< the index had no answer
    below_similarity,  ///< no candidate is similar enough
    too_few_matches,  ///< fewer matches than a fundamental matrix needs, or than the inliers asked
    ///< for
    no_model,  ///< RANSAC found no fundamental matrix
    too_few_inliers,  ///< fewer than tau
    may_be_chance,  ///< the evidence does not rule out that the inliers agree by chance
    may_be_look_alike,  ///< the evidence does not rule out that two places look alike
    not_consistent_yet  ///< the pair is convincing, but the frames around it do not confirm it
};

/** The word that stands in frames.csv; empty for Rejection::none. */
std::string to_word(Rejection rejection);

/** The inverse; nothing for another word. */
std::optional<Rejection> rejection_of(const std::string& word);

/** A phrase for a user: why such a frame is not a loop closure, or what a loop closure is. */
std::string meaning_of(Rejection rejection);

/** True for a frame that the detector cannot use because of its image or time stamp. */
bool is_unusable(Rejection rejection);

/** All rejections in order of declaration, `none` first: for counting and for documentation. */
const std::vector<Rejection>& all_rejections();

/** An earlier frame that looks like the query. */
struct Candidate
{
    FrameId frame{};
    double similarity = 0;  ///< cosine, Eq. (4), in [-1, 1]
};

/** The detector's answer for one camera frame: one row of frames.csv. */
struct FrameVerdict
{
    FrameId frame{};
    double timestamp = 0;  ///< seconds since the UNIX epoch
    std::string sensor_label;
    std::size_t keypoints = 0;
    /** The candidate with the best evidence, verified or not. */
    std::optional<Candidate> candidate;
    std::size_t matches = 0;  ///< after the ratio test, with `candidate`
    std::size_t inliers = 0;  ///< of those, in agreement with the fundamental matrix
    /** With [same_place] the probability that the frame shows the place of `candidate`, accepted
     *  from min_probability up; without it inliers / min_inliers, verified from 1 up. */
    double support = 0;
    Rejection rejection = Rejection::none;

    bool accepted() const { return rejection == Rejection::none; }
};

/** What became of one earlier frame that was looked at for a query: one row of candidates.csv. */
struct ConsideredCandidate
{
    Candidate candidate;
    std::size_t rank = 0;  ///< among the answers of the index, 1: most similar; 0: not among them
    bool checked = false;  ///< matched and verified; else what follows says nothing
    std::size_t matches = 0;
    std::size_t inliers = 0;
    /** As FrameVerdict::support, but of the pair alone, without other frames. */
    double support = 0;
    Rejection rejection = Rejection::none;  ///< none: verified
    EvidenceValues evidence{};  ///< set when `odds` is
    std::optional<PairOdds> odds{};  ///< none: [same_place] is off, or too few inliers
};

}  // namespace fild
