// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/core/verdict.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/detector_outcome.h"
#include "fild/detector/frame_describer.h"
#include "fild/detector/pair_verifier.h"
#include "fild/index/place_index.h"
#include "fild/places/place_map.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace fild
{
/** Recognises the place that a frame shows, FILD (IROS 2019) sections III-B and III-C: looks for
 *  similar frames in the index, verifies the promising ones, and follows the path from the best one
 *  to a better one. Judges pairs of frames alone; what the frames before and after say is
 *  LoopConsistency. Deterministic. Const members may run concurrently, each with its own
 *  StageTimes. */
class PlaceRecognizer
{
 public:
    /** \param global_dimension  length of the global descriptors.
     *  \param places  must outlive the recogniser.
     *  \throw std::invalid_argument on bad options. */
    PlaceRecognizer(const TDetectorOptions& options,
                    std::size_t global_dimension,
                    const PlaceMap& places);

    /** From now on the frame, one of `places`, may be the answer. Frames come in increasing id.
     *  \throw std::invalid_argument when the descriptor has another length. */
    void insert(FrameId frame, const GlobalDescriptor& descriptor);

    /** \param expected  where the camera is believed to be: with follow_belief what this camera saw
     *  there
     *         is verified, too.
     *  \param times  receives "index_search", "cells", "matching", "verification" and "evidence".
     *  \return the verdict on the best pair, all that was looked at, and what a loop is made of but
     *  its pose. */
    DetectorOutcome recognize(const FrameDescription& query,
                              std::optional<FrameId> expected,
                              StageTimes& times) const;

    /** Verifies the query with the entry's candidate, which the outcome names from then on.
     *  \param times  receives "matching", "verification" and "evidence". */
    void compare(const HashedFeatures& query,
                 ConsideredCandidate& entry,
                 DetectorOutcome& outcome,
                 StageTimes& times) const;

    /** Memory of the global descriptors. */
    std::size_t bytes() const { return index_->descriptor_bytes(); }

 private:
    class Trials;

    std::vector<Candidate> search(const GlobalDescriptor& query, StageTimes& times) const;
    std::vector<Candidate> in_order_of_promise(const CellCodes& query,
                                               std::vector<Candidate> answers,
                                               StageTimes& times) const;
    std::vector<Candidate> chosen(const std::vector<Candidate>& answers) const;
    void follow_path(const FrameDescription& query, Trials& trials) const;
    Candidate candidate_at(FrameId place, const FrameDescription& query) const;
    std::optional<FrameId> next_on_path(FrameId place, bool later) const;

    TIndexOptions index_options_;
    TCandidateOptions options_;
    double enough_log_odds_;  ///< among pairs with so much evidence the inliers count
    PairVerifier pairs_;
    const PlaceMap& places_;
    std::unique_ptr<PlaceIndex> index_;
    std::optional<FrameId> last_in_index_;
};

/** The verdict on a frame before anything is compared. */
FrameVerdict verdict_of(const FrameDescription& frame, Rejection rejection);

}  // namespace fild
