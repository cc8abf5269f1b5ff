// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/loop_edge.h"

#include "fild/rawlog/pose_conversion.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace
{
using fild::MetricView;
using fild::RigidTransform;
using fild::UncertainTransform;
using mrpt::poses::CPose3D;

UncertainTransform uncertain(const RigidTransform& b_from_a, double deviation)
{
    UncertainTransform result;
    result.b_from_a = b_from_a;
    result.covariance = deviation * deviation * cv::Matx66d::eye();
    return result;
}

/** (x y z yaw pitch roll) of the robot's motion when error number `error` of the cameras' is
 *  `size`. */
cv::Vec6d robot_errors(RigidTransform cameras, int error, double size, const MetricView& view)
{
    cv::Vec3d change;
    change(error % 3) = size;
    if (error < 3)
        cameras.translation += change;
    else
        cameras.rotation = cameras.rotation * fild::rotation_from_vector(change);
    const auto robot = robot_motion(uncertain(cameras, 0.01), view, view).value().a_from_b;
    return {robot.x(), robot.y(), robot.z(), robot.yaw(), robot.pitch(), robot.roll()};
}

TEST(Withheld, HasAWordForEachReason)
{
    std::set<std::string> words;
    const auto last = static_cast<int>(fild::Withheld::frame_without_pose);
    for (int i = 0; i <= last; ++i) words.insert(to_word(static_cast<fild::Withheld>(i)));
    EXPECT_EQ(words.size(), static_cast<std::size_t>(last + 1));
    EXPECT_EQ(to_word(fild::Withheld::none), "");
}

TEST(RobotMotion, IsThatOfTheRobotsNotOfTheCameras)
{
    const CPose3D robot_from_camera(0.5, -0.2, 1.1, -1.5, 0, -1.6);
    const CPose3D motion(2, 0.3, 0, 0.4, 0.02, -0.01);
    MetricView view;
    view.robot_from_camera = fild::rigid_transform_from(robot_from_camera);
    const auto cameras =
        fild::rigid_transform_from((CPose3D() - robot_from_camera) + motion + robot_from_camera);
    const auto found = robot_motion(uncertain(cameras, 0.01), view, view);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(found->a_from_b.distanceTo(motion), 1e-9);
    EXPECT_NEAR(found->a_from_b.yaw(), 0.4, 1e-9);
}

// The camera's errors, one by one, moved to the robot by finite differences.
TEST(RobotMotion, IsAsUncertainAsTheCamerasErrorsMakeItAtTheRobot)
{
    const CPose3D robot_from_camera(0.5, -0.2, 1.1, -1.5, 0, -1.6);
    MetricView view;
    view.robot_from_camera = fild::rigid_transform_from(robot_from_camera);
    const auto cameras = uncertain(
        fild::rigid_transform_from((CPose3D() - robot_from_camera) +
                                   CPose3D(2, 0.3, 0, 0.4, 0.02, -0.01) + robot_from_camera),
        0);
    cv::Matx66d covariance = cv::Matx66d::zeros();
    for (int i = 0; i < 6; ++i) covariance(i, i) = 1e-4 * (i + 1);
    covariance(0, 4) = covariance(4, 0) = 5e-5;

    cv::Matx66d robot_by_camera;
    for (int i = 0; i < 6; ++i)
    {
        constexpr double kStep = 1e-6;
        const auto above = robot_errors(cameras.b_from_a, i, kStep, view);
        const auto below = robot_errors(cameras.b_from_a, i, -kStep, view);
        for (int k = 0; k < 6; ++k) robot_by_camera(k, i) = (above(k) - below(k)) / (2 * kStep);
    }
    const cv::Matx66d expected = robot_by_camera * covariance * robot_by_camera.t();
    const auto found = robot_motion({cameras.b_from_a, covariance}, view, view);
    ASSERT_TRUE(found.has_value());
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            EXPECT_NEAR(found->covariance(row, column), expected(row, column), 1e-8)
                << row << ", " << column;
}

TEST(UnscaledMotion, IsInTheAxesOfTheRobot)
{
    const CPose3D robot_from_camera(0.5, -0.2, 1.1, -M_PI / 2, 0, -M_PI / 2);
    MetricView view;
    view.robot_from_camera = fild::rigid_transform_from(robot_from_camera);
    const CPose3D turn(0, 0, 0, 0.3, 0, 0);
    const auto cameras =
        fild::rigid_transform_from((CPose3D() - robot_from_camera) + turn + robot_from_camera);
    const auto found = unscaled_motion({cameras.rotation, {0, 0, 1}}, view, view);
    EXPECT_LT(cv::norm(found.direction - cv::Vec3d(1, 0, 0)), 1e-9) << "ahead";
    EXPECT_NEAR(fild::mrpt_pose_from({found.rotation, {}}).yaw(), 0.3, 1e-9);
}

TEST(RobotMotion, IsNoneWithoutACovarianceToMakeAnInformationOf)
{
    EXPECT_FALSE(robot_motion(uncertain({}, 0), {}, {}).has_value());
    auto singular = uncertain({}, 0.01);
    singular.covariance(3, 3) = 0;
    EXPECT_FALSE(robot_motion(singular, {}, {}).has_value());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(robot_motion(uncertain({}, nan), {}, {}).has_value());
    EXPECT_FALSE(
        robot_motion(uncertain({cv::Matx33d::eye(), {nan, 0, 0}}, 0.01), {}, {}).has_value());
}

}  // namespace
