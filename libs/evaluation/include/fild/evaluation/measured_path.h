// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/frame_poses.h"

#include <vector>

namespace fild
{
/** Poses that a sensor of the robot measured along the way, at times of its own. */
struct MeasuredPath
{
    std::vector<TimedPose> poses;  ///< in the order of time; x forward, y left, z up
    bool oriented = true;  ///< false: the rotations say nothing (GPS)
};

/** Between measurements further apart than this nothing is interpolated, seconds. */
constexpr double kMaxMeasurementGap = 5;

/** A heading is the direction from where the robot was so long before to where it is so long after,
 *  seconds; it stood still when these are less than kLeastMovement metres apart. */
constexpr double kHeadingWindow = 1;
constexpr double kLeastMovement = 1;

/** The pose of each frame, interpolated in time: position linearly, rotation along the shortest
 *  arc. Frames before the first or after the last measurement (by more than kMaxPoseTimeDifference)
 *  or within a gap have none.
 *
 *  A path without orientation gets the heading of the robot as its direction of motion, level. A
 *  frame taken standing still has no heading, and so no pose: whatever is claimed of it is neither
 *  right nor wrong. Driving backwards looks like driving forwards turned round. */
std::vector<PosedFrame> poses_along(const MeasuredPath& path,
                                    const std::vector<FrameVerdict>& frames);

}  // namespace fild
