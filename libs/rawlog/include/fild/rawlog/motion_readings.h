// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/geodetic.h"

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>

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
    mrpt::poses::CPose3D pose;  ///< in a fixed frame of the sensor's own; may be not finite
    /** Of (x y z yaw pitch roll) of `pose`, positive definite. */
    std::optional<mrpt::math::CMatrixDouble66> covariance;
    bool is_planar = false;  ///< z, pitch and roll are not measured
};

/** What the actions of one step say of the robot's movement. Value type. */
struct MovementReading
{
    mrpt::poses::CPose3D movement;  ///< from the robot before the step; may be not finite
    /** Of (x y z yaw pitch roll) of `movement`; of a planar one that of z is the mean of those of x
     *  and y, as the height drifts as the way does, and pitch and roll have none. */
    std::optional<mrpt::math::CMatrixDouble66> covariance;
    bool is_planar = false;
};

/** How a GPS position was computed, as NMEA's GGA message says. */
enum class FixQuality
{
    single,  ///< also PPS, and what a receiver estimates
    differential,
    rtk_float,
    rtk_fixed
};

/** A GPS fix. Value type. */
struct GpsFix
{
    GeodeticPosition place;  ///< of the antenna; the height is that over the sea, as GGA tells it
    double hdop = 1;  ///< horizontal dilution of precision, > 0
    FixQuality quality = FixQuality::single;
    cv::Vec3d robot_from_antenna;  ///< metres: where the antenna is on the robot
};

/** Of CObservationOdometry and CObservationRobotPose; nothing for all others. A covariance that
 *  cannot be one (not finite, not positive definite) is left out. */
std::optional<PoseReading> pose_reading_of(const mrpt::obs::CObservation& observation);

/** The first movement among the actions; nothing when there is none. */
std::optional<MovementReading> movement_reading_of(const mrpt::obs::CActionCollection& actions);

/** True for CObservationGPS, with a fix or without. */
bool is_gps(const mrpt::obs::CObservation& observation);

/** True for CObservationGPS with a GGA message, the only one that is read. */
bool has_gga(const mrpt::obs::CObservation& observation);

/** Nothing for other observations, without a GGA message, and when it tells no fix: quality 0, a
 *  position typed in by hand or simulated, numbers that are no place, or 0 N 0 E, which receivers
 *  write that have not found their position yet. */
std::optional<GpsFix> gps_fix_of(const mrpt::obs::CObservation& observation);

}  // namespace fild
