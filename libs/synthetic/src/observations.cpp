// SPDX-License-Identifier: BSD-3-Clause
#include "observations.h"

#include "camera_mount.h"
#include "fild/core/random.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/synthetic/geodetic.h"
#include "seeded_generator.h"

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/system/datetime.h>

#include <array>
#include <cmath>

namespace fild
{
namespace
{
using mrpt::img::CImage;
using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DQuat;

mrpt::obs::CObservationImage::Ptr image_observation(const TSensorOptions& options,
                                                    const mrpt::math::TPose3D& robot_from_camera,
                                                    const CImage& image)
{
    auto observation = mrpt::obs::CObservationImage::Create();
    observation->image = image;
    observation->cameraParams = mrpt_camera_from(camera_of(options));
    observation->cameraPose = CPose3D(robot_from_camera);
    return observation;
}

mrpt::obs::CObservationStereoImages::Ptr stereo_observation(const TSensorOptions& options,
                                                            const CImage& left,
                                                            const CImage& right)
{
    const auto cameras = robot_from_cameras(options);
    const CPose3D robot_from_left(cameras.at(0));
    auto observation = mrpt::obs::CObservationStereoImages::Create();
    observation->imageLeft = left;
    observation->imageRight = right;
    observation->hasImageRight = true;
    observation->leftCamera = observation->rightCamera = mrpt_camera_from(camera_of(options));
    observation->cameraPose = CPose3DQuat(robot_from_left);
    observation->rightCameraPose = options.toe_in_deg == 0
                                       ? CPose3DQuat(CPose3D(options.baseline_m, 0, 0, 0, 0, 0))
                                       : CPose3DQuat(CPose3D(cameras.at(1)) - robot_from_left);
    return observation;
}

mrpt::obs::CObservation3DRangeScan::Ptr range_observation(const TSensorOptions& options,
                                                          const CImage& image,
                                                          const cv::Mat& depth)
{
    auto observation = mrpt::obs::CObservation3DRangeScan::Create();
    observation->sensorPose = robot_from_mount(options);
    observation->relativePoseIntensityWRTDepth = mount_from_camera();
    observation->cameraParams = mrpt_camera_from(camera_of(options));
    observation->cameraParamsIntensity = observation->cameraParams;
    observation->hasIntensityImage = true;
    observation->intensityImage = image;
    observation->hasRangeImage = true;
    observation->range_is_depth = true;
    observation->maxRange = static_cast<float>(options.max_range_m);
    observation->rangeUnits = 0.001F;
    observation->rangeImage_setSize(depth.rows, depth.cols);
    cv::Mat_<std::uint16_t> millimetres(depth.rows, depth.cols, observation->rangeImage.data());
    for (int row = 0; row < depth.rows; ++row)
        for (int column = 0; column < depth.cols; ++column)
        {
            const double metres = static_cast<double>(depth.at<float>(row, column));
            millimetres(row, column) = metres <= options.max_range_m
                                           ? static_cast<std::uint16_t>(std::lround(1000 * metres))
                                           : std::uint16_t{0};
        }
    return observation;
}

mrpt::poses::CPose2D planar(const mrpt::math::TPose3D& pose)
{
    return {pose.x, pose.y, pose.yaw};
}

/** What a receiver with such noise says of its fixes: RTK fixed or float, differential or single.
 *  */
std::uint8_t fix_quality(double noise_m)
{
    if (noise_m <= 0.05) return 4;
    if (noise_m <= 0.5) return 5;
    return noise_m <= 1 ? 2 : 1;
}
}  // namespace

std::vector<CObservation::Ptr> camera_observations(const TSensorOptions& options,
                                                   mrpt::Clock::time_point stamp,
                                                   const std::vector<CImage>& images,
                                                   const cv::Mat& depth)
{
    const auto stamped = [&](const CObservation::Ptr& observation, const std::string& label)
    {
        observation->timestamp = stamp;
        observation->sensorLabel = label;
        return observation;
    };
    const auto cameras = robot_from_cameras(options);
    const std::string only = "CAMERA1";
    switch (options.sensor)
    {
        case SensorKind::mono:
            return {stamped(image_observation(options, cameras.at(0), images.at(0)), only)};
        case SensorKind::stereo:
            return {stamped(stereo_observation(options, images.at(0), images.at(1)), only)};
        case SensorKind::rgbd:
            return {stamped(range_observation(options, images.at(0), depth), only)};
        case SensorKind::pair:
            break;
    }
    const auto left = image_observation(options, cameras.at(0), images.at(0));
    const auto right = image_observation(options, cameras.at(1), images.at(1));
    std::vector<CObservation::Ptr> both{stamped(left, "CAMERA_LEFT"),
                                        stamped(right, "CAMERA_RIGHT")};
    both[1]->timestamp =
        mrpt::Clock::fromDouble(mrpt::Clock::toDouble(stamp) + options.right_delay_seconds);
    return both;
}

CObservation::Ptr planar_odometry_observation(mrpt::Clock::time_point stamp,
                                              const mrpt::math::TPose3D& start_from_robot)
{
    auto observation = mrpt::obs::CObservationOdometry::Create();
    observation->timestamp = stamp;
    observation->sensorLabel = "ODOMETRY";
    observation->odometry = planar(start_from_robot);
    return observation;
}

CObservation::Ptr robot_pose_observation(mrpt::Clock::time_point stamp,
                                         const mrpt::math::TPose3D& start_from_robot,
                                         const OdometryDeviation& deviation)
{
    auto observation = mrpt::obs::CObservationRobotPose::Create();
    observation->timestamp = stamp;
    observation->sensorLabel = "ODOMETRY";
    observation->pose.mean = CPose3D(start_from_robot);
    constexpr double kAttitude = 1e-3;  // rad, of pitch and roll, which do not drift
    const std::array<double, 6> deviations{deviation.position_m,
                                           deviation.position_m,
                                           deviation.position_m,
                                           deviation.heading_rad,
                                           kAttitude,
                                           kAttitude};
    for (int i = 0; i < 6; ++i)
    {
        const double each = deviations.at(static_cast<std::size_t>(i));
        observation->pose.cov(i, i) = each * each;
    }
    return observation;
}

mrpt::obs::CActionCollection movement_action(mrpt::Clock::time_point stamp,
                                             const mrpt::math::TPose3D& start_from_before,
                                             const mrpt::math::TPose3D& start_from_robot)
{
    mrpt::obs::CActionRobotMovement2D movement;
    movement.timestamp = stamp;
    movement.computeFromOdometry(planar(start_from_robot) - planar(start_from_before), {});
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    return actions;
}

CObservation::Ptr gps_observation(const TSensorOptions& options,
                                  mrpt::Clock::time_point stamp,
                                  const mrpt::math::TPose3D& map_from_robot,
                                  std::uint64_t seed,
                                  std::uint64_t frame)
{
    auto noise = seeded_generator(seed, RandomPurpose::gps, frame);
    const auto error = [&] { return options.gps_noise_m * standard_normal(noise); };
    const double east = map_from_robot.x + error();
    const double north = map_from_robot.y + error();
    const auto place = geodetic_from_map({east, north, map_from_robot.z + 2 * error()});

    mrpt::obs::gnss::Message_NMEA_GGA gga;
    mrpt::system::TTimeParts utc;
    mrpt::system::timestampToParts(stamp, utc);
    gga.fields.UTCTime.hour = utc.hour;
    gga.fields.UTCTime.minute = utc.minute;
    gga.fields.UTCTime.sec = utc.second;
    gga.fields.latitude_degrees = place.latitude_deg;
    gga.fields.longitude_degrees = place.longitude_deg;
    gga.fields.altitude_meters = place.height_m;
    gga.fields.orthometric_altitude = gga.fields.corrected_orthometric_altitude = place.height_m;
    gga.fields.fix_quality = fix_quality(options.gps_noise_m);
    gga.fields.satellitesUsed = 8;
    gga.fields.thereis_HDOP = true;
    gga.fields.HDOP = 1;

    auto observation = mrpt::obs::CObservationGPS::Create();
    observation->timestamp = observation->originalReceivedTimestamp = stamp;
    observation->has_satellite_timestamp = true;
    observation->sensorLabel = "GPS";
    observation->setMsg(gga);
    return observation;
}

}  // namespace fild
