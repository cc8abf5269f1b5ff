// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/se3.h"
#include "fild/graph/trajectory.h"

namespace fild
{
/** A pose and how certain it is. */
struct UncertainPose
{
    int segment = 0;
    Rigid map_from_robot;
    /** Sum of all movements' covariances up to here, each taken to the map by its adjoint: the
     *  difference of two, taken to the later pose, is the covariance of the movement between. */
    Matrix6 accumulated = Matrix6::Zero();
    /** Covariance of the pose itself, position and rotation vector along the map's axes. */
    std::optional<Matrix6> absolute;
    bool is_independent = false;  ///< `absolute` shares no error with that of other poses
    double planar_attitude = 0;  ///< radians: pitch and roll are unknown by so much; 0: known
};

struct Trajectory::Frame
{
    FrameId id{};
    double timestamp = 0;
    UncertainPose at;
};

}  // namespace fild
