// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/se3.h"

#include "random_poses.h"

#include <gtest/gtest.h>

namespace
{
using fild::Matrix6;
using fild::Rigid;
using fild::Vector6;
using fild::testing::random_pose;
using mrpt::poses::CPose3D;

/** The motion of a small error. */
Rigid small_motion(const Vector6& tangent)
{
    const Eigen::Vector3d turn = tangent.tail<3>();
    const double angle = turn.norm();
    Rigid motion;
    motion.translation = tangent.head<3>();
    if (angle > 0) motion.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    return motion;
}

TEST(Rigid, GoesToMrptAndBack)
{
    std::mt19937_64 generator(1);
    for (int i = 0; i < 20; ++i)
    {
        const auto a = random_pose(generator);
        const auto b = random_pose(generator);
        const CPose3D product = a + b;
        const Rigid rigid = fild::to_rigid(a) * fild::to_rigid(b);
        EXPECT_LT(fild::to_pose(rigid).distanceTo(product), 1e-12);
        EXPECT_LT(fild::tangent_of(fild::to_rigid(product).inverse() * rigid).norm(), 1e-7);
        EXPECT_LT(fild::tangent_of(rigid.inverse() * rigid).norm(), 1e-7);
    }
}

TEST(Rigid, TangentIsTranslationAndRotationVector)
{
    const Vector6 error = (Vector6() << 1, 2, 3, 0.1, -0.2, 0.3).finished();
    EXPECT_LT((fild::tangent_of(small_motion(error)) - error).norm(), 1e-12);
    EXPECT_EQ(fild::tangent_of(Rigid()).norm(), 0);
}

TEST(Rigid, AdjointTakesErrorsFromOneEndToTheOther)
{
    constexpr double kStep = 1e-6;
    std::mt19937_64 generator(2);
    const Rigid motion = fild::to_rigid(random_pose(generator));
    const Matrix6 analytic = fild::adjoint(motion);
    for (int i = 0; i < 6; ++i)
    {
        const Rigid moved = motion * small_motion(kStep * Vector6::Unit(i)) * motion.inverse();
        EXPECT_LT((fild::tangent_of(moved) / kStep - analytic.col(i)).norm(), 1e-4) << i;
    }
}

TEST(Rigid, TangentByParametersIsTheDerivative)
{
    constexpr double kStep = 1e-6;
    std::mt19937_64 generator(3);
    for (int n = 0; n < 10; ++n)
    {
        const auto pose = random_pose(generator);
        const Matrix6 analytic = fild::tangent_by_parameters(pose);
        for (int i = 0; i < 6; ++i)
        {
            Vector6 p;
            p << pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll();
            p(i) += kStep;
            const CPose3D moved(p(0), p(1), p(2), p(3), p(4), p(5));
            const Vector6 numeric =
                fild::tangent_of(fild::to_rigid(pose).inverse() * fild::to_rigid(moved)) / kStep;
            EXPECT_LT((numeric - analytic.col(i)).norm(), 1e-4) << i;
        }
    }
}

}  // namespace
