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

TEST(Withheld, HasAWordForEachReason)
{
    std::set<std::string> words;
    for (const auto reason : fild::all_withheld()) words.insert(to_word(reason));
    EXPECT_EQ(words.size(), fild::all_withheld().size());
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
    EXPECT_GT(found->covariance(0, 0), 0);
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
