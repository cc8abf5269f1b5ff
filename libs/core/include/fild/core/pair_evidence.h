// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace fild
{
/** The kinds of evidence that two frames show the same place, in the order of their columns in
 *  candidates.csv. Each is a share in (0, 1), smoothed as (count + 1) / (total + 3), so that small
 *  counts stay near a third. A match is close when its codes differ in at most a fifth of their
 *  bits. */
enum class Evidence
{
    /** Inliers among the matches. */
    inlier_share,
    /** Inliers that share one rotation (within 15 degrees) and scale (within half an octave). */
    shape_share,
    /** Matches among the keypoints that were compared with any, of the image with fewer. */
    match_share,
    /** Close matches among all matches. Many close matches that do not agree on one motion are
     *  typical of repeated things: windows, doors, signs. */
    close_share,
    /** Matches whose keypoints both lie in the part that both images show, as predicted from the
     *  inliers. Views that overlap little have wrong matches outside it. */
    overlap_share
};

constexpr std::size_t kEvidenceKinds = 5;

/** The enumerator's name: an .ini key and a column of candidates.csv. */
std::string to_word(Evidence kind);

/** A number for each kind of evidence, indexed by the enumerator. */
using EvidenceValues = std::array<double, kEvidenceKinds>;

constexpr std::size_t to_index(Evidence kind)
{
    return static_cast<std::size_t>(kind);
}

/** Natural logarithms of likelihood ratios: the evidence if both frames show the same place,
 *  against the evidence under another explanation. Value type. */
struct PairOdds
{
    double against_chance = 0;  ///< if the inliers agree by chance
    double against_look_alike = 0;  ///< if two places look alike

    /** Log odds that the pair shows one place, with equal prior odds for the same place, chance and
     *  a look-alike. */
    double log_odds() const;
};

/** 1 / (1 + exp(-log_odds)). */
double probability_of(double log_odds);
/** The inverse. \param probability  in (0, 1). */
double log_odds_of(double probability);

}  // namespace fild
