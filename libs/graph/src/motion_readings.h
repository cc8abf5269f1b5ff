// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "se3.h"
#include "trajectory_frame.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
}  // namespace mrpt::obs

namespace fild
{
/** What one observation says of the robot's pose. Value type. */
struct PoseReading
{
    Rigid pose;  ///< in a fixed frame of the sensor's own
    std::optional<Matrix6> covariance;  ///< as UncertainPose::absolute
    bool is_planar = false;
};

/** What the actions of one step say of the robot's movement. Value type. */
struct MovementReading
{
    Rigid movement;
    std::optional<Matrix6> covariance;  ///< in the tangent
    bool is_planar = false;
};

/** A GPS fix. Value type. */
struct GpsFix
{
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;
    double hdop = 1;
    Eigen::Vector3d antenna_on_robot = Eigen::Vector3d::Zero();
};

/** Of CObservationOdometry and CObservationRobotPose; nothing for all others. The pose may be not
 *  finite. A covariance that cannot be one (not finite, not positive definite) is left out. */
std::optional<PoseReading> pose_reading_of(const mrpt::obs::CObservation& observation);

/** The first movement among the actions; nothing when there is none. */
std::optional<MovementReading> movement_reading_of(const mrpt::obs::CActionCollection& actions);

/** True for CObservationGPS, with a fix or without. */
bool is_gps(const mrpt::obs::CObservation& observation);

/** True for CObservationGPS with a GGA message, the only one that is read. */
bool has_gga(const mrpt::obs::CObservation& observation);

/** Nothing for other observations, without a GGA message, and when it tells no fix. */
std::optional<GpsFix> gps_fix_of(const mrpt::obs::CObservation& observation);

/** Metres east, north and up of `origin` (WGS 84, linear about it: 3 cm off at 500 m). */
Eigen::Vector3d local_position(const GpsFix& fix, const GpsFix& origin);

}  // namespace fild
