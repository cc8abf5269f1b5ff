// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace fild
{
/** The kinds of evidence that two frames show the same place, in the order of their columns in
 *  candidates.csv. Each is a share in (0, 1), smoothed so that few counts say little. */
enum class Evidence
{
    inlier_share,  ///< of the matches, those in agreement with the fundamental matrix
    shape_share,  ///< of the inliers, those of one rotation (15 degrees) and scale (half an octave)
    affine_share,  ///< of the inliers, those that one affine map takes to within 3 % of the image
    match_share,  ///< matches, of the keypoints of the image that has fewer
    close_inlier_share,  ///< of the matches at a tenth of the bits or less, the inliers
    /** Of the matches, those at a tenth of the bits or less. Many nearly equal codes among matches
     *  that do not agree are the mark of things made alike: windows, doors, signs. */
    close_share,
    /** Of the matches, those both of whose keypoints the other image should show, by the inliers
     *  around them. A true view that does not overlap much has wrong matches outside. */
    overlap_share,
    /** Of the strong keypoints about the inliers that the candidate should show, those for which
     *  there is a similar one where they should be. Where nearly all are found, nearly all matches
     *  must agree, too; in a place that only looks alike they do not. */
    confirmed_share
};

constexpr std::size_t kEvidenceKinds = 8;

/** The enumerator's name: an .ini key and a column of candidates.csv. */
std::string to_word(Evidence kind);

/** A number for each kind of evidence, indexed by the enumerator. */
using EvidenceValues = std::array<double, kEvidenceKinds>;

constexpr std::size_t to_index(Evidence kind)
{
    return static_cast<std::size_t>(kind);
}

/** How much more likely the evidence of a pair is when both frames show the same place: logarithms
 *  of likelihood ratios. Value type. */
struct PairOdds
{
    double against_chance = 0;  ///< than when the inliers agree by chance
    double against_look_alike = 0;  ///< than when two places look alike

    /** Logarithm of the odds that the pair shows one place when same, chance and look-alike were
     *  equally likely before. */
    double log_odds() const;
};

/** 1 / (1 + exp(-log_odds)). */
double probability_of(double log_odds);
/** The inverse. \param probability  in (0, 1). */
double log_odds_of(double probability);

}  // namespace fild
