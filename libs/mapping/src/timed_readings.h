// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/graph/trajectory_frame.h"
#include "reading_clock.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** The robot's pose at one moment. */
struct TimedReading
{
    double seconds = 0;
    UncertainPose at;
};

/** A camera frame, and how many readings there were before it. */
struct AwaitedFrame
{
    FrameId id{};
    double timestamp = 0;
    std::size_t arrival = 0;
};

/** The pose at a share of the way from a to b; below 0 and above 1 as if the robot moved on. */
Rigid between(const Rigid& a, const Rigid& b, double share);

/** The frame's pose, out of the run of readings that has its time; of several, of the one that came
 *  nearest to it in the recording. Before the first and after the last reading of a run the robot
 *  moves on as it did, for as long as one reading is from the next. Nothing further away, or in a
 *  gap. */
std::optional<UncertainPose> pose_at(const std::vector<TimedReading>& readings,
                                     const std::vector<ClockRun>& runs,
                                     const AwaitedFrame& frame,
                                     double max_gap_s);

}  // namespace fild
