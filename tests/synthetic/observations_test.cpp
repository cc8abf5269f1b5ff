// SPDX-License-Identifier: BSD-3-Clause
#include "observations.h"

#include "fild/rawlog/camera_conversion.h"
#include "fild/synthetic/geodetic.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <cmath>

namespace
{
using fild::SensorKind;
using fild::TSensorOptions;
using mrpt::img::CImage;
using mrpt::math::TPose3D;
using mrpt::poses::CPose3D;
namespace obs = mrpt::obs;

const auto kStamp = mrpt::Clock::fromDouble(1577836800.5);

TSensorOptions options_of(SensorKind sensor)
{
    TSensorOptions options;
    options.sensor = sensor;
    options.camera_pitch_deg = 3;
    return options;
}

/** The camera observation, of the class it should have. */
template <class Observation>
typename Observation::Ptr observe(const TSensorOptions& options, const cv::Mat& depth = {})
{
    const auto all = fild::camera_observations(options, kStamp, {CImage(), CImage()}, depth);
    EXPECT_EQ(all.size(), 1U);
    const auto& made = all.front();
    EXPECT_EQ(made->timestamp, kStamp);
    EXPECT_EQ(made->sensorLabel, "CAMERA1");
    return std::dynamic_pointer_cast<Observation>(made);
}

void expect_camera(const mrpt::img::TCamera& camera, const TSensorOptions& options)
{
    const auto expected = fild::camera_of(options);
    const auto model = fild::camera_model_from(camera);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->fx, expected.fx);
    EXPECT_EQ(model->cx, expected.cx);
    EXPECT_EQ(model->cy, expected.cy);
    EXPECT_EQ(model->width, 640);
    EXPECT_EQ(model->lens, fild::LensModel::none);
}

void expect_pose(const CPose3D& pose, const TPose3D& expected)
{
    EXPECT_LT((pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>() -
               CPose3D(expected).getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>())
                  .sum_abs(),
              1e-9)
        << pose << " is not " << CPose3D(expected);
}

TEST(CameraObservation, MonoHasCameraAndPose)
{
    const auto options = options_of(SensorKind::mono);
    const auto image = observe<obs::CObservationImage>(options);
    ASSERT_TRUE(image);
    expect_camera(image->cameraParams, options);
    expect_pose(image->cameraPose, robot_from_cameras(options)[0]);
}

TEST(CameraObservation, StereoHasBothCamerasAndThePoseBetween)
{
    const auto options = options_of(SensorKind::stereo);
    const auto pair = observe<obs::CObservationStereoImages>(options);
    ASSERT_TRUE(pair);
    EXPECT_TRUE(pair->hasImageRight);
    EXPECT_FALSE(pair->hasImageDisparity);
    EXPECT_TRUE(pair->areImagesRectified());
    expect_camera(pair->leftCamera, options);
    expect_camera(pair->rightCamera, options);
    const CPose3D left(pair->cameraPose);
    expect_pose(left, robot_from_cameras(options)[0]);
    expect_pose(left + CPose3D(pair->rightCameraPose), robot_from_cameras(options)[1]);
}

TEST(CameraObservation, OfAPairIsAnImageOfEachCamera)
{
    auto options = options_of(SensorKind::pair);
    options.toe_in_deg = 3;
    options.lens_k1 = -0.2;
    const auto both = fild::camera_observations(options, kStamp, {CImage(), CImage()}, {});
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0]->sensorLabel, "CAMERA_LEFT");
    EXPECT_EQ(both[1]->sensorLabel, "CAMERA_RIGHT");
    EXPECT_EQ(both[0]->timestamp, kStamp);
    EXPECT_NEAR(mrpt::Clock::toDouble(both[1]->timestamp), 1577836800.504, 1e-6);
    for (std::size_t i = 0; i < both.size(); ++i)
    {
        const auto image = std::dynamic_pointer_cast<obs::CObservationImage>(both[i]);
        ASSERT_TRUE(image);
        expect_pose(image->cameraPose, robot_from_cameras(options)[i]);
        EXPECT_EQ(image->cameraParams.k1(), -0.2);
    }
    const CPose3D left(robot_from_cameras(options)[0]);
    const CPose3D right(robot_from_cameras(options)[1]);
    // Their optical axes meet half the baseline's length by the tangent before them.
    const auto meeting = left.composePoint({0, 0, 0.25 / std::sin(3 * CV_PI / 180)});
    const auto again = right.composePoint({0, 0, 0.25 / std::sin(3 * CV_PI / 180)});
    EXPECT_NEAR(meeting.x, again.x, 1e-9);
    EXPECT_NEAR(meeting.y, again.y, 1e-9);
    EXPECT_NEAR(meeting.y, 0, 1e-9);
    EXPECT_GT(meeting.x, 4);
}

TEST(CameraObservation, RangeScanHasDepthInMillimetresUpToItsRange)
{
    auto options = options_of(SensorKind::rgbd);
    options.max_range_m = 20;
    cv::Mat depth(480, 640, CV_32FC1, cv::Scalar(1.2346));
    depth.at<float>(3, 5) = 0;
    depth.at<float>(4, 5) = 19.999F;
    depth.at<float>(5, 5) = 20.01F;
    depth.at<float>(6, 5) = 1e6F;
    const auto scan = observe<obs::CObservation3DRangeScan>(options, depth);
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->rangeImage.rows(), 480);
    EXPECT_EQ(scan->rangeImage.cols(), 640);
    EXPECT_EQ(scan->rangeImage(0, 0), 1235);
    EXPECT_EQ(scan->rangeImage(3, 5), 0);
    EXPECT_EQ(scan->rangeImage(4, 5), 19999);
    EXPECT_EQ(scan->rangeImage(5, 5), 0);
    EXPECT_EQ(scan->rangeImage(6, 5), 0);
    EXPECT_TRUE(scan->range_is_depth);
    EXPECT_FLOAT_EQ(scan->rangeUnits, 0.001F);
    EXPECT_FLOAT_EQ(scan->maxRange, 20);
    EXPECT_TRUE(scan->doDepthAndIntensityCamerasCoincide());
    expect_camera(scan->cameraParams, options);
    expect_camera(scan->cameraParamsIntensity, options);
    expect_pose(scan->sensorPose + scan->relativePoseIntensityWRTDepth,
                robot_from_cameras(options)[0]);
}

// MRPT's own projection puts a pixel where our camera says it is.
TEST(CameraObservation, RangeScanProjectsToTheTruePoints)
{
    auto options = options_of(SensorKind::rgbd);
    const cv::Mat depth(480, 640, CV_32FC1, cv::Scalar(4));
    const auto scan = observe<obs::CObservation3DRangeScan>(options, depth);
    obs::T3DPointsProjectionParams projection;
    projection.takeIntoAccountSensorPoseOnRobot = true;
    scan->unprojectInto(*scan, projection);
    const auto camera = fild::camera_of(options);
    const CPose3D robot_from_camera(robot_from_cameras(options)[0]);
    ASSERT_EQ(scan->points3D_x.size(), 640U * 480U);
    for (std::size_t i = 0; i < scan->points3D_x.size(); i += 999)
    {
        const double u = scan->points3D_idxs_x[i];
        const double v = scan->points3D_idxs_y[i];
        const auto point = robot_from_camera.composePoint(
            {4 * (u - camera.cx) / camera.fx, 4 * (v - camera.cy) / camera.fy, 4});
        EXPECT_NEAR(static_cast<double>(scan->points3D_x[i]), point.x, 1e-3);
        EXPECT_NEAR(static_cast<double>(scan->points3D_y[i]), point.y, 1e-3);
        EXPECT_NEAR(static_cast<double>(scan->points3D_z[i]), point.z, 1e-3);
    }
}

TEST(OdometryObservation, CarriesThePoseSinceTheStart)
{
    const auto made = fild::planar_odometry_observation(kStamp, {3, -2, 0, 0.5, 0, 0});
    const auto odometry = std::dynamic_pointer_cast<obs::CObservationOdometry>(made);
    ASSERT_TRUE(odometry);
    EXPECT_EQ(odometry->timestamp, kStamp);
    EXPECT_EQ(odometry->odometry, mrpt::poses::CPose2D(3, -2, 0.5));
}

TEST(OdometryObservation, CarriesAPoseInSpaceWithItsCovariance)
{
    const TPose3D pose(3, -2, 0.4, 0.5, 0.01, -0.02);
    const auto made = fild::robot_pose_observation(kStamp, pose, {0.3, 0.02});
    const auto robot_pose = std::dynamic_pointer_cast<obs::CObservationRobotPose>(made);
    ASSERT_TRUE(robot_pose);
    expect_pose(robot_pose->pose.mean, pose);
    EXPECT_NEAR(robot_pose->pose.cov(0, 0), 0.09, 1e-12);
    EXPECT_NEAR(robot_pose->pose.cov(3, 3), 4e-4, 1e-12);
    EXPECT_GT(robot_pose->pose.cov.det(), 0);
}

TEST(OdometryObservation, AnActionCarriesTheMovementInTheRobotsAxes)
{
    const auto actions =
        fild::movement_action(kStamp, {5, 5, 0, M_PI / 2, 0, 0}, {5, 7, 0, M_PI / 2, 0, 0});
    ASSERT_EQ(actions.size(), 1U);
    const auto* movement = dynamic_cast<const obs::CActionRobotMovement2D*>(&actions.get(0));
    ASSERT_NE(movement, nullptr);
    EXPECT_NEAR(movement->rawOdometryIncrementReading.x(), 2, 1e-12);
    EXPECT_NEAR(movement->rawOdometryIncrementReading.y(), 0, 1e-12);
    EXPECT_NEAR(movement->poseChange->getMeanVal().x(), 2, 1e-12);
    EXPECT_EQ(movement->timestamp, kStamp);
}

/** Metres to the east and to the north that a GPS observation is off, and up. */
std::vector<double> gps_error(const TSensorOptions& options, std::uint64_t frame)
{
    const TPose3D truth(120, 60, 0, 1, 0, 0);
    const auto made = fild::gps_observation(options, kStamp, truth, 1, frame);
    const auto gps = std::dynamic_pointer_cast<obs::CObservationGPS>(made);
    const auto& fields = gps->getMsgByClass<obs::gnss::Message_NMEA_GGA>().fields;
    const auto expected = fild::geodetic_from_map({120, 60, 0});
    const double metres_per_degree = 111000;  // roughly, of latitude
    return {(fields.longitude_degrees - expected.longitude_deg) * metres_per_degree *
                std::cos(expected.latitude_deg * M_PI / 180),
            (fields.latitude_degrees - expected.latitude_deg) * metres_per_degree,
            fields.altitude_meters - expected.height_m};
}

TEST(GpsObservation, HasTheAskedNoise)
{
    TSensorOptions options;
    options.gps_noise_m = 3;
    const std::vector<double> asked{3, 3, 6};
    constexpr int kFixes = 2000;
    std::vector<double> mean(3);
    std::vector<double> square(3);
    for (std::uint64_t frame = 0; frame < kFixes; ++frame)
    {
        const auto error = gps_error(options, frame);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            mean[axis] += error[axis] / kFixes;
            square[axis] += error[axis] * error[axis] / kFixes;
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        EXPECT_NEAR(mean[axis], 0, asked[axis] * 0.1);
        EXPECT_NEAR(std::sqrt(square[axis]), asked[axis], asked[axis] * 0.07);
    }
}

TEST(GpsObservation, SaysTheQualityThatFitsItsNoise)
{
    const std::vector<std::pair<double, int>> qualities{{0.02, 4}, {0.3, 5}, {0.8, 2}, {2, 1}};
    for (const auto& [noise, quality] : qualities)
    {
        TSensorOptions options;
        options.gps_noise_m = noise;
        const auto gps = std::dynamic_pointer_cast<obs::CObservationGPS>(
            fild::gps_observation(options, kStamp, {}, 1, 0));
        EXPECT_EQ(gps->getMsgByClass<obs::gnss::Message_NMEA_GGA>().fields.fix_quality, quality);
    }
}

TEST(GpsObservation, WithoutNoiseIsExactAndStampedInUtc)
{
    TSensorOptions options;
    options.gps_noise_m = 0;
    for (const double error : gps_error(options, 5)) EXPECT_EQ(error, 0);
    const auto made = fild::gps_observation(
        options, mrpt::Clock::fromDouble(1577836800 + 3600 * 2 + 60 * 3 + 4.5), {}, 1, 0);
    const auto gps = std::dynamic_pointer_cast<obs::CObservationGPS>(made);
    const auto& utc = gps->getMsgByClass<obs::gnss::Message_NMEA_GGA>().fields.UTCTime;
    EXPECT_EQ(utc.hour, 2);
    EXPECT_EQ(utc.minute, 3);
    EXPECT_NEAR(utc.sec, 4.5, 1e-6);
}

}  // namespace
