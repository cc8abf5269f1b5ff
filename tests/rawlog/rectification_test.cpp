// SPDX-License-Identifier: BSD-3-Clause
// Stereo pairs with distortion, toe-in, different intrinsics and sizes against a scene that is
// drawn as the rectified cameras would take it.
#include "drawn_rawlog.h"
#include "fild/rawlog/camera_conversion.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/pose_conversion.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <opencv2/calib3d.hpp>

#include <cmath>

namespace
{
using namespace fild::testing;
using fild::CameraModel;
using fild::DepthDefect;
using fild::Frame;
using fild::FrameBuilder;
using fild::FrameContent;
using fild::RigidTransform;
using fild::TInputOptions;
using mrpt::obs::CObservationStereoImages;
using mrpt::poses::CPose3D;

CameraModel pinhole_of(double focal, cv::Size size, cv::Point2d off_centre = {0, 0})
{
    CameraModel camera;
    camera.fx = focal;
    camera.fy = 1.01 * focal;
    camera.cx = (size.width - 1) / 2.0 + off_centre.x;
    camera.cy = (size.height - 1) / 2.0 + off_centre.y;
    camera.width = size.width;
    camera.height = size.height;
    return camera;
}

CameraModel bent(CameraModel camera)
{
    camera.lens = fild::LensModel::plumb_bob;
    camera.distortion = {-0.28, 0.07, 0.0002, -0.0001, 0};
    return camera;
}

/** Rays through all pixels, at depth 1. */
std::vector<cv::Point2d> rays_of(const CameraModel& camera)
{
    std::vector<cv::Point2d> pixels;
    for (int row = 0; row < camera.height; ++row)
        for (int column = 0; column < camera.width; ++column) pixels.emplace_back(column, row);
    const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    std::vector<cv::Point2d> rays;
    cv::undistortPoints(pixels,
                        rays,
                        k,
                        std::vector<double>(camera.distortion.begin(), camera.distortion.end()),
                        cv::noArray(),
                        cv::noArray(),
                        {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-12});
    return rays;
}

/** Brightness of a wall 6 m ahead of the left camera. */
double brightness_of(double x, double y)
{
    return 128 + 50 * std::sin(4 * x + y) + 45 * std::cos(3 * y - 0.7 * x);
}

constexpr double kWall = 6;

/** \param left_from_camera  the left camera as it stands on the robot. */
cv::Mat drawn_wall(const CameraModel& camera, const RigidTransform& left_from_camera)
{
    cv::Mat image(camera.height, camera.width, CV_8UC1);
    const auto rays = rays_of(camera);
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
        const auto ray = left_from_camera.rotation * cv::Vec3d(rays[i].x, rays[i].y, 1);
        const auto& eye = left_from_camera.translation;
        const auto point = eye + (kWall - eye[2]) / ray[2] * ray;
        image.at<uchar>(static_cast<int>(i) / camera.width, static_cast<int>(i) % camera.width) =
            static_cast<uchar>(std::lround(brightness_of(point[0], point[1])));
    }
    return image;
}

/** Two cameras, and where the right one is in the left one. */
struct CameraPair
{
    CameraModel left = pinhole_of(220, {320, 240});
    CameraModel right = pinhole_of(220, {320, 240});
    RigidTransform left_from_right{cv::Matx33d::eye(), {0.3, 0, 0}};
};

RigidTransform turned_in(double toe_in_deg, double pitch_deg = 0)
{
    const double degree = CV_PI / 180;
    return {fild::rotation_from_vector({pitch_deg * degree, -toe_in_deg * degree, 0}),
            {0.3, 0.004, -0.01}};
}

const CPose3D kRobotFromLeft =
    CPose3D(1, 2, 3, 0.1, 0, 0) + CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);

CObservationStereoImages::Ptr recorded(const CameraPair& pair)
{
    auto stereo = CObservationStereoImages::Create();
    stereo->sensorLabel = "PAIR";
    stereo->timestamp = mrpt::Clock::fromDouble(1);
    stereo->imageLeft = mrpt::img::CImage(drawn_wall(pair.left, {}), mrpt::img::DEEP_COPY);
    stereo->imageRight =
        mrpt::img::CImage(drawn_wall(pair.right, pair.left_from_right), mrpt::img::DEEP_COPY);
    stereo->hasImageRight = true;
    stereo->leftCamera = mrpt_camera_from(pair.left);
    stereo->rightCamera = mrpt_camera_from(pair.right);
    stereo->cameraPose = mrpt::poses::CPose3DQuat(kRobotFromLeft);
    stereo->rightCameraPose = mrpt::poses::CPose3DQuat(fild::mrpt_pose_from(pair.left_from_right));
    return stereo;
}

Frame frame_of(const CObservationStereoImages& stereo, const TInputOptions& options = {})
{
    FrameBuilder builder(options, "run.rawlog", FrameContent::metric);
    return builder.build(stereo);
}

/** The image against the wall as that camera takes it, where it shows anything: grey values. */
double mean_difference(const cv::Mat& image,
                       const CameraModel& camera,
                       const RigidTransform& left_from_camera)
{
    cv::Mat inside;
    cv::erode(image > 0, inside, cv::Mat(), {-1, -1}, 2);
    EXPECT_GT(cv::countNonZero(inside), image.rows * image.cols / 2);
    cv::Mat difference;
    cv::absdiff(image, drawn_wall(camera, left_from_camera), difference);
    return cv::mean(difference, inside)[0];
}

void expect_rectified(const CameraPair& pair)
{
    constexpr double kGreyValues = 1.2;  // of rounding and of interpolation
    const auto frame = frame_of(*recorded(pair));
    ASSERT_TRUE(frame.right) << to_word(frame.depth_defect);
    const auto robot_from_left = fild::rigid_transform_from(kRobotFromLeft);
    const auto left_from_view = robot_from_left.inverse() * *frame.robot_from_camera;
    EXPECT_LT(cv::norm(left_from_view.translation), 1e-9) << "a camera turns, and does not move";
    EXPECT_LT(mean_difference(frame.image, *frame.camera, left_from_view), kGreyValues);
    const auto left_from_right_view = left_from_view * frame.right->left_from_right;
    EXPECT_LT(cv::norm(left_from_right_view.translation - pair.left_from_right.translation), 1e-9);
    EXPECT_LT(mean_difference(frame.right->image, frame.right->camera, left_from_right_view),
              kGreyValues);
    EXPECT_LT(cv::norm(frame.right->left_from_right.rotation - cv::Matx33d::eye()), 1e-9);
    const auto& baseline = frame.right->left_from_right.translation;
    EXPECT_NEAR(std::max(std::abs(baseline[0]), std::abs(baseline[1])), cv::norm(baseline), 1e-9)
        << "along an axis";
    EXPECT_EQ(frame.right->camera.fx, frame.camera->fx);
    EXPECT_EQ(frame.right->camera.fy, frame.camera->fy);
    EXPECT_EQ(frame.right->camera.cy, frame.camera->cy);
}

TEST(Rectification, TurnsCamerasThatAreTurnedIn)
{
    CameraPair pair;
    pair.left_from_right = turned_in(6);
    expect_rectified(pair);
    pair.left_from_right = turned_in(-4, 2);
    expect_rectified(pair);
}

TEST(Rectification, StraightensBothLenses)
{
    CameraPair pair;
    pair.left = bent(pinhole_of(220, {320, 240}, {5, -3}));
    pair.right = bent(pinhole_of(224, {320, 240}, {-6, 2}));
    pair.left_from_right = turned_in(5, -1);
    expect_rectified(pair);
}

TEST(Rectification, BringsUnequalCamerasToOneSize)
{
    CameraPair pair;
    pair.right = bent(pinhole_of(300, {480, 360}));
    pair.left_from_right = turned_in(3);
    expect_rectified(pair);
    const auto frame = frame_of(*recorded(pair));
    EXPECT_EQ(frame.image.size(), cv::Size(320, 240));
    EXPECT_EQ(frame.right->image.size(), cv::Size(320, 240));
}

TEST(Rectification, LeavesCamerasOneAboveTheOtherUpright)
{
    CameraPair pair;
    pair.left_from_right = turned_in(0, 4);
    pair.left_from_right.translation = {0.01, 0.3, 0};
    expect_rectified(pair);
    const auto frame = frame_of(*recorded(pair));
    const auto up =
        *frame.robot_from_camera * cv::Vec3d(0, -1, 0) - *frame.robot_from_camera * cv::Vec3d();
    EXPECT_GT(up[2], 0.99);
}

TEST(Rectification, LeavesARectifiedPairAsItIs)
{
    CameraPair pair;
    pair.right.cx += 3;
    const auto stereo = recorded(pair);
    const auto frame = frame_of(*stereo);
    ASSERT_TRUE(frame.right);
    const auto stored = stereo->imageLeft.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    EXPECT_EQ(frame.image.data, stored.data) << "shared";
    EXPECT_EQ(frame.right->image.data,
              stereo->imageRight.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY).data);
    EXPECT_EQ(frame.right->camera.cx, pair.right.cx);
    EXPECT_EQ(frame.camera->fy, pair.left.fy);
}

TEST(Rectification, IsTheSameForFramesWithoutARightImageAndWithoutMetricContent)
{
    CameraPair pair;
    pair.left = bent(pair.left);
    pair.left_from_right = turned_in(5);
    const auto stereo = recorded(pair);
    const auto whole = frame_of(*stereo);
    stereo->hasImageRight = false;
    const auto alone = frame_of(*stereo);
    EXPECT_EQ(alone.depth_defect, DepthDefect::missing_right_image);
    EXPECT_EQ(cv::norm(alone.image, whole.image, cv::NORM_INF), 0);
    EXPECT_EQ(alone.robot_from_camera->rotation, whole.robot_from_camera->rotation);
    FrameBuilder builder(TInputOptions(), "run.rawlog");
    EXPECT_EQ(cv::norm(builder.build(*stereo).image, whole.image, cv::NORM_INF), 0);
}

TEST(Rectification, IsLeftOutWhereDistortionIsToStay)
{
    CameraPair pair;
    pair.left_from_right = turned_in(5);
    TInputOptions options;
    options.undistort = false;
    const auto stereo = recorded(pair);
    const auto frame = frame_of(*stereo, options);
    ASSERT_TRUE(frame.right);
    EXPECT_EQ(frame.camera->cx, pair.left.cx);
    EXPECT_LT(cv::norm(frame.right->left_from_right.rotation - pair.left_from_right.rotation), 1e-9)
        << "the depths are rectified by themselves";
}

TEST(Rectification, FollowsACalibrationThatChanges)
{
    CameraPair pair;
    pair.left_from_right = turned_in(5);
    CameraPair other;
    other.left_from_right = turned_in(-5);
    FrameBuilder builder(TInputOptions(), "run.rawlog", FrameContent::metric);
    const auto first = builder.build(*recorded(pair));
    const auto later = recorded(other);
    later->timestamp = mrpt::Clock::fromDouble(2);
    const auto second = builder.build(*later);
    EXPECT_GT(cv::norm(first.image, second.image, cv::NORM_INF), 20);
    EXPECT_EQ(cv::norm(second.image, frame_of(*recorded(other)).image, cv::NORM_INF), 0);
}

}  // namespace
