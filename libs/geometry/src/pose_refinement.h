// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_residual.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** How noisy measurements are: factors of the noise that pose_residual() assumes. */
struct MeasuredNoise
{
    double pixel_deviation_px = 1;
    double depth_factor = 1;
};

/** A pose that fits matches best. */
struct RefinedPose
{
    UncertainTransform candidate_from_query;
    MeasuredNoise noise;
    std::vector<std::size_t> inliers;  ///< indices into the matches, ascending
};

/** Matches that a pose explains: their squared Mahalanobis distance is below the 99.9 % quantile.
 */
std::vector<std::size_t> agreeing(const std::vector<MeasuredMatch>& matches,
                                  const PinholePair& cameras,
                                  const RigidTransform& candidate_from_query,
                                  const MeasuredNoise& noise);

/** Gauss-Newton from `start` on, noise and inliers measured anew after each step; see
 *  RelativePoseEstimator. \return nothing when fewer than six matches agree, or they leave a degree
 *  of freedom open. Deterministic. */
std::optional<RefinedPose> refined_pose(const std::vector<MeasuredMatch>& matches,
                                        const PinholePair& cameras,
                                        const RigidTransform& start);

}  // namespace fild
