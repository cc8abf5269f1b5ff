// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/trajectory.h"

#include "message_of.h"
#include "random_poses.h"

#include <mrpt/poses/CPose3DPDFGaussian.h>

namespace
{
using fild::FrameId;
using fild::MeasuredMotion;
using fild::trajectory_from_motions;
using fild::testing::message_of;
using mrpt::poses::CPose3D;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

mrpt::math::CMatrixDouble66 small_covariance(std::mt19937_64& generator)
{
    auto covariance = fild::testing::random_information(generator).inverse_LLt();
    covariance *= 1e-2;
    return covariance;
}

/** Motions between frames 0, 1, 2... at seconds of the same number. */
std::vector<MeasuredMotion> random_motions(std::size_t count)
{
    std::mt19937_64 generator(5);
    std::vector<MeasuredMotion> motions;
    for (std::size_t i = 0; i < count; ++i)
        motions.push_back({FrameId{i},
                           FrameId{i + 1},
                           static_cast<double>(i),
                           static_cast<double>(i + 1),
                           {fild::testing::moderate_pose(generator), small_covariance(generator)}});
    return motions;
}

// MRPT composes uncertain poses in their parameters, we sum up in the tangent.
TEST(TrajectoryFromMotions, MotionAndCovarianceAreMrptsComposition)
{
    using Pdf = mrpt::poses::CPose3DPDFGaussian;
    const auto motions = random_motions(3);
    const auto trajectory = trajectory_from_motions(motions);
    Pdf expected(motions[1].motion.a_from_b, motions[1].motion.covariance);
    expected += Pdf(motions[2].motion.a_from_b, motions[2].motion.covariance);
    const auto motion = trajectory.motion(FrameId{1}, FrameId{3}).value();
    EXPECT_LT(motion.a_from_b.distanceTo(expected.mean), 1e-9);
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            EXPECT_NEAR(motion.covariance(i, j),
                        expected.cov(i, j),
                        0.02 * std::sqrt(expected.cov(i, i) * expected.cov(j, j)))
                << i << " " << j;
}

TEST(TrajectoryFromMotions, MotionBackIsTheInverse)
{
    const auto trajectory = trajectory_from_motions(random_motions(4));
    const auto there = trajectory.motion(FrameId{0}, FrameId{3}).value();
    const auto back = trajectory.motion(FrameId{3}, FrameId{0}).value();
    EXPECT_LT((there.a_from_b + back.a_from_b).norm(), 1e-9);
    mrpt::poses::CPose3DPDFGaussian expected(there.a_from_b, there.covariance);
    expected = -expected;
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(back.covariance(i, i) / expected.cov(i, i), 1, 0.1) << i;
}

TEST(TrajectoryFromMotions, BeginsASegmentWhereMotionsDoNotMeet)
{
    auto motions = random_motions(4);
    motions.erase(motions.begin() + 1);
    const auto trajectory = trajectory_from_motions(motions);
    EXPECT_EQ(trajectory.poses().size(), 5U);
    EXPECT_EQ(trajectory.report().resets, 1U);
    EXPECT_FALSE(trajectory.motion(FrameId{1}, FrameId{2}));
    EXPECT_EQ(trajectory.pose(FrameId{2})->segment, 1);
    EXPECT_EQ(trajectory.pose(FrameId{2})->timestamp, 2);
    EXPECT_THAT(trajectory_from_motions({}).poses(), IsEmpty());
}

TEST(TrajectoryFromMotions, RefusesBadMotions)
{
    auto motions = random_motions(2);
    motions[1].motion.covariance(2, 2) = 0;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { trajectory_from_motions(motions); }),
                HasSubstr("covariance of the motion from frame 1 to frame 2: singular"));
    motions = random_motions(2);
    std::swap(motions[0], motions[1]);
    EXPECT_THAT(message_of<std::invalid_argument>([&] { trajectory_from_motions(motions); }),
                HasSubstr("frames must increase"));
}

}  // namespace
