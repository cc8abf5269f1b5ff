// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/pose_graph.h"
#include "fild/graph/trajectory.h"

#include <vector>

namespace fild
{
/** The poses of all frames, when those of the keyframes are known better than by the trajectory:
 *  between two keyframes the trajectory's motion is kept, and what is then missing at the second
 *  keyframe is spread over the way.
 *  \param graph  of the trajectory (build_pose_graph()), its nodes at their new poses.
 *  \return for each pose of the trajectory the corrected one. Before the first and after the last
 *          node of a segment its motion is appended; a segment without nodes stays where it is. */
std::vector<TrajectoryPose> corrected_poses(const Trajectory& trajectory, const PoseGraph& graph);

}  // namespace fild
