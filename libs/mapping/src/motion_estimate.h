// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/cancellation.h"
#include "fild/core/geodetic.h"
#include "fild/graph/loop_selection.h"
#include "fild/mapping/motion_source_use.h"
#include "gps_recorder.h"

#include <optional>
#include <set>
#include <vector>

namespace fild
{
/** A receiver with a part in the map. */
struct UsedReceiver
{
    const GpsTrack* track = nullptr;  ///< of the GpsRecord that the estimate was made from
    double noise_scale = 1;
};

/** The robot's way by all sources of motion, before any loop. */
struct MotionEstimate
{
    /** What was measured between frames, placed in the map. */
    Trajectory motion;
    /** The same frames where GPS and motion together say that they are. */
    Trajectory way;
    std::vector<MotionSourceUse> sources{};
    std::vector<UsedReceiver> receivers{};
    std::optional<GeodeticPosition> origin{};  ///< of a map that lies east, north and up of it

    /** Of these keyframes, by each receiver. */
    std::vector<std::vector<GraphPrior>> priors(const std::set<FrameId>& keyframes,
                                                double max_gap_s) const;
};

std::vector<GraphPrior> joined(const std::vector<std::vector<GraphPrior>>& priors);

/** Joins odometry and the images' motion, see fused_motion(), each with its noise_scales(), and
 *  places them by the receivers. Without either the most certain receiver gives the motion, too.
 *
 *  A receiver is left out when none of its fixes is at the time of a frame; when it contradicts the
 *  more certain ones, or more receivers than it agrees with; and when less than half of its
 *  positions fit the motion, even if it is four times as uncertain as it says.
 *  \param gps  outlives the estimate. */
MotionEstimate estimate_motion(const Trajectory& odometry,
                               const Trajectory& vision,
                               const GpsRecord& gps,
                               const TGraphOptions& options,
                               const CheckCancelled& check_cancelled);

/** Of the nodes. */
std::set<FrameId> frames_of(const PoseGraph& graph);

}  // namespace fild
