// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <string>

namespace fild::testing
{
inline mrpt::obs::CObservationOdometry odometry_at(double seconds,
                                                   const mrpt::poses::CPose2D& pose,
                                                   const std::string& label = "WHEELS")
{
    mrpt::obs::CObservationOdometry odometry;
    odometry.timestamp = mrpt::Clock::fromDouble(seconds);
    odometry.sensorLabel = label;
    odometry.odometry = pose;
    return odometry;
}

inline mrpt::obs::CObservationRobotPose robot_pose_at(double seconds,
                                                      const mrpt::poses::CPose3D& pose,
                                                      double variance)
{
    mrpt::obs::CObservationRobotPose observation;
    observation.timestamp = mrpt::Clock::fromDouble(seconds);
    observation.pose.mean = pose;
    observation.pose.cov.setDiagonal(6, variance);
    return observation;
}

inline mrpt::obs::CObservationImage image_at(double seconds)
{
    mrpt::obs::CObservationImage image;
    image.timestamp = mrpt::Clock::fromDouble(seconds);
    return image;
}

/** A planar movement with standard deviations of 0.1 m, 0.2 m and 0.01 rad. */
inline mrpt::obs::CActionCollection movement_2d(const mrpt::poses::CPose2D& movement)
{
    mrpt::math::CMatrixDouble33 covariance;
    covariance(0, 0) = 0.01;
    covariance(1, 1) = 0.04;
    covariance(2, 2) = 1e-4;
    mrpt::obs::CActionRobotMovement2D action;
    action.poseChange = mrpt::poses::CPosePDFGaussian::Create(movement, covariance);
    mrpt::obs::CActionCollection actions;
    actions.insert(action);
    return actions;
}

inline mrpt::obs::CActionCollection movement_3d(const mrpt::poses::CPose3D& movement,
                                                double variance)
{
    mrpt::obs::CActionRobotMovement3D action;
    action.poseChange.mean = movement;
    action.poseChange.cov.setDiagonal(6, variance);
    mrpt::obs::CActionCollection actions;
    actions.insert(action);
    return actions;
}

/** A GGA fix; quality 0: none. */
inline mrpt::obs::CObservationGPS gps_at(double seconds,
                                         double latitude_deg,
                                         double longitude_deg,
                                         double height_m,
                                         std::uint8_t quality = 1)
{
    mrpt::obs::gnss::Message_NMEA_GGA gga;
    gga.fields.latitude_degrees = latitude_deg;
    gga.fields.longitude_degrees = longitude_deg;
    gga.fields.altitude_meters = height_m;
    gga.fields.fix_quality = quality;
    mrpt::obs::CObservationGPS gps;
    gps.timestamp = mrpt::Clock::fromDouble(seconds);
    gps.sensorLabel = "GPS";
    gps.setMsg(gga);
    return gps;
}

}  // namespace fild::testing
