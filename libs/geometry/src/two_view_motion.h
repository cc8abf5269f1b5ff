// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/descriptors.h"
#include "fild/core/rigid_transform.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** Pixels of two calibrated images, pixel k of one matched with pixel k of the other. */
struct TwoViews
{
    CameraModel a_camera;
    std::vector<PixelPosition> a;
    CameraModel b_camera;
    std::vector<PixelPosition> b;
};

/** What two images alone tell of a movement. */
struct TwoViewMotion
{
    RigidTransform b_from_a;  ///< the translation has length 1: its scale is unknown
    std::vector<std::size_t> inliers;  ///< points before both cameras, ascending
};

/** Rotation and direction of movement from the essential matrix: OpenCV's USAC (MAGSAC++), then
 *  Gauss-Newton on the distances from epipolar lines (Sampson's), with Cauchy's loss.
 *  \param max_error_px  distance from the epipolar line. \return nothing when fewer than 8 points
 *  agree. Deterministic. A camera that only turns has no direction: the answer is then arbitrary,
 *  and parallax is what tells. */
std::optional<TwoViewMotion> two_view_motion(const TwoViews& views,
                                             double max_error_px,
                                             int random_state);

}  // namespace fild
