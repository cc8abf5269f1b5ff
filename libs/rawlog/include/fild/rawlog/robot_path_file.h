// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/recording.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace fild
{
/** Reads the path of a camera, `seconds x y z qx qy qz qw` a line as in TUM's ground truth (camera:
 *  x right, y down, z forward), as the path of the robot of StampedPose. The fixed frame stays.
 *  \throw std::runtime_error naming file and line. */
std::vector<StampedPose> read_camera_path(const std::string& path);

/** Writes a path, `seconds x y z qx qy qz qw` a line, each number so that it reads back the same.
 */
void write_robot_path(std::ostream& stream, const std::vector<StampedPose>& path);

}  // namespace fild
