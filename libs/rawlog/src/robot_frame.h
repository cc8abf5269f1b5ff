// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose3D.h>
#include <mrpt/poses/CPose3D.h>

namespace fild
{
/** Pose on the robot (x forward, y left, z up) of a camera that looks forward from its origin
 *  (camera: x right, y down, z forward). Also how MRPT's range scans place their colour camera. */
inline mrpt::poses::CPose3D robot_from_camera()
{
    constexpr double kQuarterTurn = 1.57079632679489661923;
    return {0, 0, 0, -kQuarterTurn, 0, -kQuarterTurn};
}

}  // namespace fild
