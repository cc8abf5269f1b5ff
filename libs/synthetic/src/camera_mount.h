// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/sensors.h"

namespace mrpt::poses
{
class CPose3D;
}

namespace fild
{
/** Where the (left) camera is on the robot, with the robot's axes: x along the optical axis, y
 *  left, z up. */
mrpt::poses::CPose3D robot_from_mount(const TSensorOptions& options);

/** From the axes of a mount to those of its camera: x right, y down, z along the optical axis. */
mrpt::poses::CPose3D mount_from_camera();

}  // namespace fild
