// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/pair_evidence.h"

#include <vector>

namespace fild
{
/** What was found when two frames were matched and verified. */
struct MatchedPair
{
    const HashedFeatures& query;
    const HashedFeatures& candidate;
    const std::vector<Match>& matches;  ///< after the ratio test
    const std::vector<Match>& inliers;  ///< of those, in agreement with the fundamental matrix
};

/** Measures each kind of evidence. The inliers tell where a keypoint of one image should be in the
 *  other: an affine map fitted to them, moved so that the nearest inlier fits exactly.
 *  With fewer than 3 inliers, or none that an affine map of a scale between 1/5 and 5 fits, the
 *  views are taken to overlap wholly. Cost: keypoints x inliers.
 *  Deterministic. \throw std::invalid_argument when a frame has not a shape for each position. */
EvidenceValues measure_evidence(const MatchedPair& pair);

}  // namespace fild
