// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/graph/trajectory.h"
#include "fild/mapping/pair_poses.h"
#include "fild/places/place_map.h"

#include <vector>

namespace fild
{
/** How the robot moved from frame to frame, from stereo pairs or depth images alone: each frame is
 *  matched with the one before and solved as a loop closure is.
 *
 *  Of several cameras the one with depths in the most frames counts. Where the near things are too
 *  few for a pose, the frame before is triangulated against those before it (MotionScale): so the
 *  far things count too. A frame that does not fit all the same is left out, up to ten in a row,
 *  when a later one does; else the chain is broken there, which trajectory_from_motions() makes a
 *  new segment of. Deterministic, with any number of threads.
 *  \param end  the first frame that is not looked at.
 *  \param max_speed_m_per_s  a motion that is faster by the time stamps, and longer than a metre,
 *         is taken for wrong.
 *  \param check_cancelled  as MapBuilder::build().
 *  \param times receives "visual_odometry", and within it "matching", "verification",
 *         "relative_pose" and "motion_depth".
 *  \return none when no frame has depths. */
std::vector<MeasuredMotion> visual_odometry(const PlaceMap& places,
                                            FrameId end,
                                            const TDetectorOptions& options,
                                            double max_speed_m_per_s,
                                            StageTimes& times,
                                            const CheckCancelled& check_cancelled);

}  // namespace fild
