// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/descriptors.h"
#include "fild/core/keypoint_depths.h"
#include "fild/core/rigid_transform.h"
#include "fild/geometry/depth_options.h"

#include <cstdint>
#include <vector>

namespace fild
{
/** Two frames of one moving camera, and how the odometry says it moved between them. Refers to its
 *  arguments. */
struct MovedView
{
    const CameraModel& camera;  ///< of both frames, a pinhole
    const std::vector<PixelPosition>& current;  ///< keypoints whose depths are sought
    const std::vector<PixelPosition>& earlier;
    const std::vector<Match>& matches;  ///< query: index into current; candidate: into earlier
    RigidTransform earlier_from_current;  ///< between the camera frames
    double scale_deviation = 0;  ///< relative standard deviation of the odometry's length
};

/** Depths of a camera that moves: keypoints are triangulated against an earlier frame.
 *
 *  The odometry gives the length of the baseline alone; rotation and direction come from the
 *  matches (essential matrix), which see the pitch and roll of the camera that a planar odometry
 *  does not. Points have a depth when they are before both cameras, their rays enclose enough
 *  parallax, and they fall near enough to where they are seen. No depths at all, source none: too
 *  short a baseline, too few matches, or images and odometry disagree on the motion.
 *  A baseline of a tenth of the scene's depth serves well: some metres in a street.
 *  \param seed of RANSAC. Deterministic. \throw std::invalid_argument when an index of a match is
 *  beyond the keypoints or the camera has a lens distortion. */
KeypointDepths depths_from_motion(const MovedView& view,
                                  const TDepthOptions& options,
                                  std::uint64_t seed);

}  // namespace fild
