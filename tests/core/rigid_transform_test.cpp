// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/rigid_transform.h"

#include "fild/core/frame.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <limits>

namespace
{
using fild::rotation_from_vector;
using fild::vector_from_rotation;

TEST(RigidTransform, ComposesAndInverts)
{
    const fild::RigidTransform b_from_a{rotation_from_vector({0.3, -0.2, 1.1}), {1, 2, 3}};
    const fild::RigidTransform c_from_b{rotation_from_vector({-1, 0.4, 0.2}), {-4, 0, 2}};
    const cv::Vec3d point(0.5, -7, 2);
    EXPECT_LT(cv::norm((c_from_b * b_from_a) * point - c_from_b * (b_from_a * point)), 1e-12);
    EXPECT_LT(cv::norm(b_from_a.inverse() * (b_from_a * point) - point), 1e-12);
    EXPECT_EQ(fild::RigidTransform() * point, point);
}

TEST(RigidTransform, CrossMatrixMultipliesAsTheCrossProduct)
{
    const cv::Vec3d v(1, 2, 3);
    const cv::Vec3d p(-2, 0.5, 4);
    EXPECT_LT(cv::norm(fild::cross_matrix(v) * p - v.cross(p)), 1e-12);
}

TEST(RigidTransform, TurnsAQuarterAboutZ)
{
    const auto rotation = rotation_from_vector({0, 0, CV_PI / 2});
    EXPECT_LT(cv::norm(rotation * cv::Vec3d(1, 0, 0) - cv::Vec3d(0, 1, 0)), 1e-12);
}

TEST(RigidTransform, RotationVectorsComeBack)
{
    for (const double angle : {0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.0, 3.141, CV_PI - 1e-8, CV_PI})
        for (const cv::Vec3d& axis : {cv::Vec3d(1, 0, 0),
                                      cv::Vec3d(0, -1, 0),
                                      cv::Vec3d(0.6, 0, 0.8),
                                      cv::Vec3d(2, -3, 6) / 7})
        {
            const auto rotation = rotation_from_vector(angle * axis);
            const auto w = vector_from_rotation(rotation);
            EXPECT_LT(cv::norm(rotation_from_vector(w) - rotation), 1e-7) << angle << axis;
            EXPECT_NEAR(cv::norm(w), angle, 1e-7);
            EXPECT_LT(cv::norm(rotation * rotation.t() - cv::Matx33d::eye()), 1e-12);
        }
}

TEST(UsableBaseline, IsBesideOrBelowAndNotTooShort)
{
    const auto usable = [](double x, double y, double z) {
        return fild::is_usable_baseline({cv::Matx33d::eye(), {x, y, z}});
    };
    EXPECT_TRUE(usable(0.1, 0, 0));
    EXPECT_TRUE(usable(0, 0.1, 0)) << "one above the other";
    EXPECT_TRUE(usable(0.1, 0, 0.1));
    EXPECT_FALSE(usable(0, 0, 0));
    EXPECT_FALSE(usable(-0.1, 0, 0));
    EXPECT_FALSE(usable(0.0001, 0, 0));
    EXPECT_FALSE(usable(0.01, 0, 0.5)) << "one behind the other";
    EXPECT_FALSE(usable(std::numeric_limits<double>::quiet_NaN(), 0, 0));
    EXPECT_FALSE(usable(std::numeric_limits<double>::infinity(), 0, 0));
}

TEST(DepthDefect, HasAWordForEach)
{
    EXPECT_EQ(to_word(fild::DepthDefect::none), "");
    EXPECT_EQ(to_word(fild::DepthDefect::unusable_baseline), "unusable_baseline");
}

}  // namespace
