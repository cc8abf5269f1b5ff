// SPDX-License-Identifier: BSD-3-Clause
#include "motion_readings.h"

#include "fild/core/angle.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDF.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace fild
{
namespace
{
using mrpt::poses::CPose3D;

/** The matrix, unless it cannot be a covariance. */
std::optional<Matrix6> if_covariance(const Matrix6& matrix)
{
    if (!matrix.allFinite() || Eigen::LLT<Matrix6>(matrix).info() != Eigen::Success)
        return std::nullopt;
    return matrix;
}

/** Covariance of MRPT's parameters as one in the tangent. */
std::optional<Matrix6> in_tangent(const CPose3D& pose,
                                  const mrpt::math::CMatrixDouble66& covariance)
{
    const Matrix6 by_parameters = tangent_by_parameters(pose);
    return if_covariance(by_parameters * to_eigen(covariance) * by_parameters.transpose());
}

/** Covariance of (x y yaw), in the tangent; pitch, roll and z are told elsewhere. */
std::optional<Matrix6> planar_in_tangent(const CPose3D& movement,
                                         const mrpt::math::CMatrixDouble33& covariance)
{
    mrpt::math::CMatrixDouble66 spatial;
    spatial.setIdentity();  // for the check alone
    const std::array<int, 3> place{0, 1, 3};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            spatial(place.at(static_cast<std::size_t>(row)),
                    place.at(static_cast<std::size_t>(column))) = covariance(row, column);
    auto tangent = in_tangent(movement, spatial);
    if (!tangent) return std::nullopt;
    for (const int unknown : {2, 3, 4})
    {
        tangent->row(unknown).setZero();
        tangent->col(unknown).setZero();
    }
    // The height drifts as the way does.
    (*tangent)(2, 2) = ((*tangent)(0, 0) + (*tangent)(1, 1)) / 2;
    return tangent;
}

/** Covariance along the map's axes of an absolute pose. */
std::optional<Matrix6> along_map_axes(const CPose3D& pose,
                                      const mrpt::math::CMatrixDouble66& covariance)
{
    const auto tangent = in_tangent(pose, covariance);
    if (!tangent) return std::nullopt;
    Matrix6 to_map = Matrix6::Zero();
    to_map.topLeftCorner<3, 3>() = to_map.bottomRightCorner<3, 3>() = to_rigid(pose).rotation;
    return to_map * *tangent * to_map.transpose();
}

MovementReading planar_movement(const mrpt::obs::CActionRobotMovement2D& action)
{
    MovementReading reading;
    reading.is_planar = true;
    if (!action.poseChange)
    {
        reading.movement = to_rigid(CPose3D(action.rawOdometryIncrementReading));
        return reading;
    }
    const auto [covariance, mean] = action.poseChange->getCovarianceAndMean();
    reading.movement = to_rigid(CPose3D(mean));
    reading.covariance = planar_in_tangent(CPose3D(mean), covariance);
    return reading;
}
}  // namespace

std::optional<PoseReading> pose_reading_of(const mrpt::obs::CObservation& observation)
{
    PoseReading reading;
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation))
    {
        reading.pose = to_rigid(CPose3D(odometry->odometry));
        reading.is_planar = true;
        return reading;
    }
    if (const auto* robot = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation))
    {
        reading.pose = to_rigid(robot->pose.mean);
        reading.covariance = along_map_axes(robot->pose.mean, robot->pose.cov);
        return reading;
    }
    return std::nullopt;
}

std::optional<MovementReading> movement_reading_of(const mrpt::obs::CActionCollection& actions)
{
    for (const auto& action : actions)
    {
        const auto* each = action.get_ptr().get();
        if (const auto* planar = dynamic_cast<const mrpt::obs::CActionRobotMovement2D*>(each))
            return planar_movement(*planar);
        if (const auto* spatial = dynamic_cast<const mrpt::obs::CActionRobotMovement3D*>(each))
        {
            const auto& change = spatial->poseChange;
            return MovementReading{
                to_rigid(change.mean), in_tangent(change.mean, change.cov), false};
        }
    }
    return std::nullopt;
}

bool is_gps(const mrpt::obs::CObservation& observation)
{
    return dynamic_cast<const mrpt::obs::CObservationGPS*>(&observation) != nullptr;
}

bool has_gga(const mrpt::obs::CObservation& observation)
{
    const auto* gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(&observation);
    return gps != nullptr && gps->hasMsgClass<mrpt::obs::gnss::Message_NMEA_GGA>();
}

std::optional<GpsFix> gps_fix_of(const mrpt::obs::CObservation& observation)
{
    using mrpt::obs::gnss::Message_NMEA_GGA;
    if (!has_gga(observation)) return std::nullopt;
    const auto& gps = dynamic_cast<const mrpt::obs::CObservationGPS&>(observation);
    const auto& gga = gps.getMsgByClass<Message_NMEA_GGA>().fields;
    const auto hdop = static_cast<double>(gga.HDOP);
    GpsFix fix;
    fix.latitude_deg = gga.latitude_degrees;
    fix.longitude_deg = gga.longitude_degrees;
    fix.height_m = gga.altitude_meters;
    if (gga.thereis_HDOP && hdop > 0) fix.hdop = hdop;
    const auto& antenna = gps.sensorPose;
    fix.antenna_on_robot = {antenna.x(), antenna.y(), antenna.z()};
    const bool is_finite =
        std::isfinite(fix.latitude_deg + fix.longitude_deg + fix.height_m + fix.hdop);
    if (gga.fix_quality == 0 || !is_finite || std::abs(fix.latitude_deg) > 90) return std::nullopt;
    return fix;
}

Eigen::Vector3d local_position(const GpsFix& fix, const GpsFix& origin)
{
    constexpr double kEquatorialRadius = 6378137;  // m, WGS 84
    constexpr double kEccentricity2 = 6.69437999014e-3;
    const double latitude = origin.latitude_deg * kRadiansPerDegree;
    const double bulge = 1 - kEccentricity2 * std::sin(latitude) * std::sin(latitude);
    const double prime_vertical = kEquatorialRadius / std::sqrt(bulge);
    const double meridian = prime_vertical * (1 - kEccentricity2) / bulge;
    const double east_deg = std::remainder(fix.longitude_deg - origin.longitude_deg, 360);
    const double north_deg = fix.latitude_deg - origin.latitude_deg;
    return {east_deg * kRadiansPerDegree * (prime_vertical + origin.height_m) * std::cos(latitude),
            north_deg * kRadiansPerDegree * (meridian + origin.height_m),
            fix.height_m - origin.height_m};
}

}  // namespace fild
