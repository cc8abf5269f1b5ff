// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/graph/pose_graph.h"
#include "fild/graph/trajectory.h"

#include <vector>

namespace fild
{
/** A loop closure with its metric pose. Value type. */
struct LoopMeasurement
{
    FrameId candidate{};
    FrameId query{};
    RelativeMotion motion;  ///< a: the candidate, b: the query
};

/** True when build_pose_graph() takes it as a loop's motion: all finite, covariance positive
 *  definite. */
bool is_usable(const RelativeMotion& motion);

/** A pose graph, and what could not become part of it. Value type. */
struct BuiltGraph
{
    PoseGraph graph;
    std::vector<LoopMeasurement> loops_without_pose;  ///< one of their frames has no pose
};

/** The pose graph of a trajectory and its loops: keyframes as select_keyframes() chooses them, an
 *  odometry edge from each to the next of its segment, an edge for each loop, in their order.
 *  \throw std::invalid_argument on bad options, on a loop of a frame with itself, or naming the
 * loop whose pose or covariance is not finite, or whose covariance is singular. Deterministic. */
BuiltGraph build_pose_graph(const Trajectory& trajectory,
                            const std::vector<LoopMeasurement>& loops,
                            const TGraphOptions& options);

}  // namespace fild
