// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/rigid_transform.h"
#include "fild/core/verdict.h"

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>

namespace fild
{
/** Why a frame whose depth was asked for carries none. */
enum class DepthDefect
{
    none,  ///< it has a right image or a depth image, or nobody asked
    mono,  ///< one camera alone
    not_calibrated,  ///< one of the cameras has no calibration
    distorted,  ///< the lens distortion was left in: pixels are not straight rays
    missing_right_image,  ///< none in the observation, not to be read, or not 8 bit
    unusable_baseline,  ///< see is_usable_baseline()
    missing_depth_image,  ///< none in the observation, not to be read, or of no size
    empty_depth_image  ///< not one depth in it is a number above 0
};

/** The enumerator's name; empty for DepthDefect::none. */
std::string to_word(DepthDefect defect);

/** The right image of a stereo pair. */
struct RightView
{
    cv::Mat image;  ///< as Frame::image
    CameraModel camera;  ///< of `image`, a pinhole
    RigidTransform left_from_right;  ///< between the cameras' axes: x right, y down, z forward
    double seconds_later = 0;  ///< than the left image, by the time stamps; below 0: before it
};

/** True when two cameras can measure depth: the baseline is finite and at least a millimetre, the
 *  right camera is not on the left one's left (a negative baseline: a wrong sign, or images
 *  swapped), and it stands beside it or below, at 30 degrees or more from the optical axis. */
bool is_usable_baseline(const RigidTransform& left_from_right);

/** One camera frame as the detector sees it.
 *
 *  `image` is 8 bit, one channel (grey) or three (BGR, OpenCV's order), lens distortion already
 *  undone, and a stereo pair rectified, where that was asked for. Value type; copies share the
 *  pixels, as cv::Mat does. */
struct Frame
{
    FrameId id{};  ///< position among all camera frames of the run, from 0
    double timestamp = 0;  ///< seconds since the UNIX epoch
    std::string sensor_label;
    cv::Mat image;
    std::optional<CameraModel>
        camera;  ///< of `image`, hence after undistortion; none: uncalibrated
    /** Why the frame cannot be used (`image` is then empty), or Rejection::none. Such a frame keeps
     *  its id, so that indices go on matching the recording and its ground truth. */
    Rejection defect = Rejection::none;

    // For metric poses; filled only where they are asked for.
    std::optional<RightView> right;
    /** Float, metres along the optical axis of `camera`, for each pixel of `image`; NaN where it is
     *  unknown. Empty: there is none. */
    cv::Mat depth;
    DepthDefect depth_defect = DepthDefect::none;  ///< why both `right` and `depth` are missing
    /** Pose of `camera` (x right, y down, z forward) on the robot (x forward, y left, z up). */
    std::optional<RigidTransform> robot_from_camera;
};

}  // namespace fild
