// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/graph/trajectory.h"

#include <string>
#include <vector>

namespace fild
{
/** Writes the robot's poses at frames, a line each.
 *  tum: `seconds x y z qx qy qz qw`. kitti: the 3x4 matrix map_from_robot, row by row; line i is
 *  frame i, so that each frame must have a pose. (KITTI's own files have poses of the camera.)
 *  \throw std::runtime_error when the file cannot be written, or naming the first frame without a
 *         pose (kitti). */
void write_trajectory(const std::string& path,
                      const std::vector<TrajectoryPose>& poses,
                      TrajectoryFormat format);

}  // namespace fild
