// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/pose_conversion.h"

#include "fild/core/random.h"
#include "message_of.h"

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussianInf.h>
#include <opencv2/core.hpp>

#include <array>
#include <random>

namespace
{
using fild::RigidTransform;
using fild::rotation_from_vector;
using mrpt::poses::CPose3D;

TEST(PoseConversion, KeepsMrptsMeaning)
{
    const CPose3D pose(1, -2, 3, 0.4, -0.3, 0.2);
    const auto converted = fild::rigid_transform_from(pose);
    const auto by_mrpt = pose.composePoint(mrpt::math::TPoint3D(4, 5, 6));
    const auto by_us = converted * cv::Vec3d(4, 5, 6);
    EXPECT_LT(cv::norm(by_us - cv::Vec3d(by_mrpt.x, by_mrpt.y, by_mrpt.z)), 1e-12);
    const auto back = fild::mrpt_pose_from(converted);
    EXPECT_NEAR(back.yaw(), 0.4, 1e-12);
    EXPECT_NEAR(back.pitch(), -0.3, 1e-12);
    EXPECT_NEAR(back.roll(), 0.2, 1e-12);
}

/** A pose between cameras that look forward from 1 m before the robot's origin. */
struct Pair
{
    fild::UncertainTransform candidate_from_query{
        {rotation_from_vector({0.05, 0.3, -0.02}), {0.4, -0.1, 1.2}}, {}};
    RigidTransform robot_from_camera = fild::rigid_transform_from(
        CPose3D(1, 0.2, 1.5, 0, 0.1, 0) + CPose3D(0, 0, 0, -CV_PI / 2, 0, -CV_PI / 2));

    Pair()
    {
        const std::array<double, 6> deviations{0.01, 0.02, 0.03, 0.002, 0.001, 0.003};
        for (int i = 0; i < 6; ++i)
            candidate_from_query.covariance(i, i) =
                deviations[static_cast<std::size_t>(i)] * deviations[static_cast<std::size_t>(i)];
        candidate_from_query.covariance(0, 4) = candidate_from_query.covariance(4, 0) = 5e-6;
    }
};

TEST(RobotConstraint, IsTheMovementOfTheRobot)
{
    const Pair pair;
    const auto constraint =
        robot_constraint(pair.candidate_from_query, pair.robot_from_camera, pair.robot_from_camera);
    // A map, the robot at both times, and the cameras on it.
    const auto map_from_candidate = fild::rigid_transform_from(CPose3D(5, 6, 7, 1, 0.1, 0.2));
    const auto map_from_query = map_from_candidate * fild::rigid_transform_from(constraint.mean);
    const auto between = (map_from_candidate * pair.robot_from_camera).inverse() *
                         (map_from_query * pair.robot_from_camera);
    const auto& expected = pair.candidate_from_query.b_from_a;
    EXPECT_LT(cv::norm(between.translation - expected.translation), 1e-9);
    EXPECT_LT(cv::norm(between.rotation - expected.rotation), 1e-9);
}

TEST(RobotConstraint, HasTheCovarianceOfSamples)
{
    const Pair pair;
    const auto constraint =
        robot_constraint(pair.candidate_from_query, pair.robot_from_camera, pair.robot_from_camera);
    std::mt19937_64 generator(1);
    const cv::Matx66d c = pair.candidate_from_query.covariance;
    // Cholesky by hand: all but one pair of errors are independent.
    cv::Matx66d lower = cv::Matx66d::zeros();
    for (int i = 0; i < 6; ++i) lower(i, i) = std::sqrt(c(i, i));
    lower(4, 0) = c(4, 0) / lower(0, 0);
    lower(4, 4) = std::sqrt(c(4, 4) - lower(4, 0) * lower(4, 0));

    constexpr int kSamples = 20000;
    cv::Matx66d measured = cv::Matx66d::zeros();
    for (int k = 0; k < kSamples; ++k)
    {
        cv::Vec<double, 6> normal;
        for (int i = 0; i < 6; ++i) normal[i] = fild::standard_normal(generator);
        const cv::Vec<double, 6> e = lower * normal;
        const auto& mean = pair.candidate_from_query.b_from_a;
        const RigidTransform sample{mean.rotation * rotation_from_vector({e[3], e[4], e[5]}),
                                    mean.translation + cv::Vec3d(e[0], e[1], e[2])};
        const auto pose = fild::mrpt_pose_from(pair.robot_from_camera * sample *
                                               pair.robot_from_camera.inverse());
        const auto& m = constraint.mean;
        const cv::Vec<double, 6> change(pose.x() - m.x(),
                                        pose.y() - m.y(),
                                        pose.z() - m.z(),
                                        pose.yaw() - m.yaw(),
                                        pose.pitch() - m.pitch(),
                                        pose.roll() - m.roll());
        measured += (1.0 / kSamples) * (change * change.t());
    }
    cv::Matx66d information;
    for (int i = 0; i < 6; ++i)
        for (int k = 0; k < 6; ++k) information(i, k) = constraint.cov_inv(i, k);
    const cv::Matx66d unit = information * measured;
    EXPECT_LT(cv::norm(unit - cv::Matx66d::eye()), 0.3);
    EXPECT_NEAR(cv::trace(unit), 6, 0.15);
}

TEST(RobotConstraint, RefusesACovarianceThatIsNone)
{
    Pair pair;
    pair.candidate_from_query.covariance(2, 2) = 0;
    EXPECT_THROW(
        robot_constraint(pair.candidate_from_query, pair.robot_from_camera, pair.robot_from_camera),
        std::invalid_argument);
    pair = Pair();
    pair.candidate_from_query.b_from_a = {rotation_from_vector({0, CV_PI / 2, 0}), {}};
    EXPECT_THAT(fild::testing::message_of<std::invalid_argument>(
                    [&] { robot_constraint(pair.candidate_from_query, {}, {}); }),
                ::testing::HasSubstr("90 degrees"));
}

}  // namespace
