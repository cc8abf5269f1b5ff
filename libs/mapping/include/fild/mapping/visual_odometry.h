// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/detector/loop_detector.h"
#include "fild/graph/trajectory.h"

#include <vector>

namespace fild
{
/** How the robot moved from frame to frame, from stereo pairs or depth images alone: each frame is
 *  matched with the one before and solved as a loop closure is.
 *
 *  Of several cameras the one with depths in the most frames counts. A frame that does not fit the
 *  one before is left out, up to ten in a row, when a later one does; else the chain is broken
 *  there, which trajectory_from_motions() makes a new segment of. Deterministic, with any number of
 *  threads.
 *  \param end  the first frame that is not looked at.
 *  \param times receives "visual_odometry", and within it "matching", "verification" and
 *         "relative_pose".
 *  \return none when no frame has depths. */
std::vector<MeasuredMotion> visual_odometry(const LoopDetector& detector,
                                            FrameId end,
                                            const TDetectorOptions& options,
                                            StageTimes& times);

}  // namespace fild
