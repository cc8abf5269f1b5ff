// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/motion_readings.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDF.h>

#include <array>
#include <cmath>

namespace fild
{
namespace
{
using mrpt::math::CMatrixDouble33;
using mrpt::math::CMatrixDouble66;
using mrpt::poses::CPose3D;

/** The matrix, unless it cannot be a covariance. */
template <class Matrix>
std::optional<Matrix> if_covariance(const Matrix& matrix)
{
    for (int row = 0; row < matrix.rows(); ++row)
        for (int column = 0; column < matrix.cols(); ++column)
            if (!std::isfinite(matrix(row, column))) return std::nullopt;
    Matrix upper;
    if (!matrix.chol(upper)) return std::nullopt;
    return matrix;
}

/** Covariance of (x y yaw) as one of all six. */
std::optional<CMatrixDouble66> spatial_covariance(const CMatrixDouble33& covariance)
{
    if (!if_covariance(covariance)) return std::nullopt;
    constexpr std::array<int, 3> kPlace{0, 1, 3};
    CMatrixDouble66 all;
    all.setZero();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            all(kPlace.at(static_cast<std::size_t>(row)),
                kPlace.at(static_cast<std::size_t>(column))) = covariance(row, column);
    all(2, 2) = (all(0, 0) + all(1, 1)) / 2;
    return all;
}

MovementReading planar_movement(const mrpt::obs::CActionRobotMovement2D& action)
{
    MovementReading reading;
    reading.is_planar = true;
    if (!action.poseChange)
    {
        reading.movement = CPose3D(action.rawOdometryIncrementReading);
        return reading;
    }
    const auto [covariance, mean] = action.poseChange->getCovarianceAndMean();
    reading.movement = CPose3D(mean);
    reading.covariance = spatial_covariance(covariance);
    return reading;
}

/** Nothing when there is no fix. */
std::optional<FixQuality> quality_of(int gga_quality)
{
    switch (gga_quality)
    {
        case 1:
        case 3:  // precise positioning service
        case 6:  // dead reckoning
            return FixQuality::single;
        case 2:
            return FixQuality::differential;
        case 4:
            return FixQuality::rtk_fixed;
        case 5:
            return FixQuality::rtk_float;
        default:  // 0: none; 7, 8: by hand, simulated
            return std::nullopt;
    }
}

bool is_place(const GeodeticPosition& place)
{
    constexpr double kHighest = 1e5;  // m
    const bool is_finite = std::isfinite(place.latitude_deg + place.longitude_deg + place.height_m);
    const bool is_unset = place.latitude_deg == 0 && place.longitude_deg == 0;
    return is_finite && !is_unset && std::abs(place.latitude_deg) <= 90 &&
           std::abs(place.longitude_deg) <= 360 && std::abs(place.height_m) <= kHighest;
}
}  // namespace

std::optional<PoseReading> pose_reading_of(const mrpt::obs::CObservation& observation)
{
    PoseReading reading;
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation))
    {
        reading.pose = CPose3D(odometry->odometry);
        reading.is_planar = true;
        return reading;
    }
    if (const auto* robot = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation))
    {
        reading.pose = robot->pose.mean;
        reading.covariance = if_covariance(robot->pose.cov);
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
            return MovementReading{change.mean, if_covariance(change.cov), false};
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
    const auto quality = quality_of(gga.fix_quality);
    GpsFix fix;
    fix.place = {gga.latitude_degrees, gga.longitude_degrees, gga.altitude_meters};
    if (!quality || !is_place(fix.place)) return std::nullopt;
    fix.quality = *quality;
    const auto hdop = static_cast<double>(gga.HDOP);
    if (gga.thereis_HDOP && std::isfinite(hdop) && hdop > 0) fix.hdop = hdop;
    const auto& antenna = gps.sensorPose;
    fix.robot_from_antenna = {antenna.x(), antenna.y(), antenna.z()};
    return fix;
}

}  // namespace fild
