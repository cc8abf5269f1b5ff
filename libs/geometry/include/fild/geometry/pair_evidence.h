// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/pair_evidence.h"

#include <vector>

namespace fild
{
/** Two frames, their matches and their inliers. */
struct MatchedPair
{
    const HashedFeatures& query;
    const HashedFeatures& candidate;
    const std::vector<Match>& matches;  ///< after the ratio test
    const std::vector<Match>& inliers;  ///< of those, in agreement with the fundamental matrix
    std::size_t compared;  ///< Keypoints that could have been matched, of the image with fewer.
};

/** Measures each kind of evidence. The inliers tell where a keypoint of one image should be in the
 *  other: an affine map fitted to them, moved so that the nearest inlier fits exactly.
 *  With fewer than 3 inliers, or without an affine map of a scale from 1/5 to 5, the views count as
 *  overlapping completely. Cost: keypoints x inliers, at most 200 of them. Deterministic.
 *  \throw std::invalid_argument when a frame lacks a shape or code for a position. */
EvidenceValues measure_evidence(const MatchedPair& pair);

}  // namespace fild
