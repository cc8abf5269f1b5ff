// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

#include <opencv2/core/matx.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Pose of a frame's camera, or of the robot that carries it: world_from_camera. */
struct FramePose
{
    cv::Matx33d rotation = cv::Matx33d::eye();
    cv::Vec3d position;  ///< metres
};

/** World from robot for each frame; nothing where a frame has no pose. */
using PosesOfFrames = std::vector<std::optional<FramePose>>;

/** Where something was at a time. */
struct TimedPose
{
    double timestamp = 0;  ///< seconds
    FramePose pose;
};

/** When and where a frame was taken. */
struct PosedFrame
{
    double timestamp = 0;  ///< seconds
    std::optional<FramePose> pose;  ///< none: unknown
};

/** A TUM pose belongs to the frame when their times differ by at most so many seconds. */
constexpr double kMaxPoseTimeDifference = 0.02;

/** The rotation of a unit quaternion x, y, z, w. */
cv::Matx33d rotation_of(const cv::Vec4d& quaternion);

/** Angle of the rotation between two poses, radians, in [0, pi]. */
double angle_between(const FramePose& a, const FramePose& b);

/** Reads poses in KITTI's format, 12 numbers a line (row-major 3x4 matrix), line i for frame i.
 *  Matrices that are rounded are replaced by the rotation nearest to them.
 *  \throw std::runtime_error naming file and line, or both counts when they differ. */
std::vector<PosedFrame> read_kitti_poses(const std::string& path,
                                         const std::vector<FrameVerdict>& frames);

/** Poses of a file in TUM's format, for the frames of a run. */
struct TumPoses
{
    std::vector<PosedFrame> frames;  ///< of the run, all of them
    /** 0: poses were found by time. Else line i was taken for frame i, though their times differ by
     *  at most so many seconds. */
    double seconds_off = 0;
};

/** Reads poses in TUM's format, `seconds x y z qx qy qz qw` a line. Each frame takes the line
 *  nearest in time that is at most kMaxPoseTimeDifference away, or has no pose. When fewer than
 * half of the frames have one, but there are as many lines as frames, the times are of another
 * clock, and line i belongs to frame i. Quaternions that are rounded, to a tenth or finer, are
 * normalised. \throw std::runtime_error naming file and line, when no frame has a pose, or when
 * lines of another clock are not in the order of their times. */
TumPoses read_tum_poses(const std::string& path, const std::vector<FrameVerdict>& frames);

/** Reads a trajectory in TUM's format, in the order of time.
 *  \throw std::runtime_error naming file and line, or when it holds no pose. */
std::vector<TimedPose> read_tum_trajectory(const std::string& path);

}  // namespace fild
