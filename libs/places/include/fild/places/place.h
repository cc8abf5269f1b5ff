// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/descriptors.h"
#include "fild/core/frame.h"
#include "fild/core/keypoint_depths.h"
#include "fild/core/rigid_transform.h"
#include "fild/core/verdict.h"

#include <cstddef>
#include <optional>
#include <string>

namespace fild
{
/** What a metric pose takes of a frame beyond its keypoints. Value type. */
struct MetricView
{
    std::optional<CameraModel> camera;  ///< a pinhole; none: not calibrated, or distorted
    /** As in Frame; none when metric content was not asked for. */
    std::optional<RigidTransform> robot_from_camera;
    KeypointDepths depths;  ///< from a stereo pair or a depth image
    DepthDefect depth_defect = DepthDefect::none;  ///< as in Frame
};

/** What the map keeps of a frame for loops to come. Value type. */
struct Place
{
    double timestamp = 0;  ///< seconds since the UNIX epoch
    std::string sensor_label;
    HashedFeatures local;
    MetricView metric;
    std::size_t instant = 0;  ///< see InstantCounter
    std::optional<FrameId> stands_since{};  ///< the camera shows what it did at that frame
};

}  // namespace fild
