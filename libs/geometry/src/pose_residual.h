// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/descriptors.h"
#include "fild/core/rigid_transform.h"

#include <opencv2/core/matx.hpp>

#include <optional>

namespace fild
{
/** A keypoint and, where it is known, its inverse depth (1/metres). Disparity, from which depths
 *  come, errs evenly in inverse depth. */
struct MeasuredPoint
{
    PixelPosition pixel;
    double inverse_depth = 0;  ///< 0: unknown
    double inverse_depth_deviation = 0;

    bool has_depth() const { return inverse_depth > 0; }
};

/** A match as the refinement sees it; at least one of the two has a depth. */
struct MeasuredMatch
{
    MeasuredPoint query;
    MeasuredPoint candidate;
};

/** Both cameras, pinholes. */
struct PinholePair
{
    CameraModel query;
    CameraModel candidate;
};

/** What a pose leaves of a match, pixels, pixels and 1/metres: where the point of one frame falls
 * in the other and, with depths in both, how deep. The third is 0 when there is one depth only.
 *
 *  Its covariance is pixel_variance * pixel_part + depth_part, the noise of both frames propagated
 *  to first order: depth_part from the declared deviations of the depths. */
struct PoseResidual
{
    bool has_depth_equation = false;
    cv::Vec3d value;
    cv::Matx<double, 3, 6> jacobian;  ///< by the errors of UncertainTransform
    cv::Matx33d pixel_part;
    cv::Matx33d depth_part;
};

/** \return nothing when the point lies behind the camera it is projected into. */
std::optional<PoseResidual> pose_residual(const MeasuredMatch& match,
                                          const PinholePair& cameras,
                                          const RigidTransform& candidate_from_query);

}  // namespace fild
