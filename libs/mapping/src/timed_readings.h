// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/graph/trajectory_frame.h"
#include "reading_clock.h"

#include <cstddef>
#include <limits>
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

/** Readings in the order of the recording, without the first `forgotten` ones. */
struct KeptReadings
{
    const std::vector<TimedReading>& readings;
    const std::vector<ClockRun>& runs;  ///< of all readings, with the forgotten ones
    std::size_t forgotten = 0;
};

/** The pose at a time of a run of readings, and the number of the reading that is next to it. */
struct FoundPose
{
    UncertainPose at;
    std::size_t reading = 0;
};

/** The frame's pose, out of the run of readings that has its time; of several, of the one that came
 *  nearest to it in the recording. Before the first and after the last reading of a run the robot
 *  moves on as it did, for as long as one reading is from the next. Nothing further away, or in a
 *  gap.
 *  \param best  what was found among the readings that are forgotten.
 *  \param last  number of the last reading that counts. */
std::optional<FoundPose> pose_at(const KeptReadings& kept,
                                 const AwaitedFrame& frame,
                                 double max_gap_s,
                                 std::optional<FoundPose> best = std::nullopt,
                                 std::size_t last = std::numeric_limits<std::size_t>::max());

}  // namespace fild
