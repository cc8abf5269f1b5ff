// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/motion_since_node.h"

#include "graph/observations.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
using fild::MotionSinceNode;
using mrpt::poses::CPose2D;

mrpt::obs::CObservation::Ptr odometry(double seconds, const CPose2D& pose)
{
    return std::make_shared<mrpt::obs::CObservationOdometry>(
        fild::testing::odometry_at(seconds, pose));
}

mrpt::obs::CObservation::Ptr image(double seconds)
{
    return std::make_shared<mrpt::obs::CObservationImage>(fild::testing::image_at(seconds));
}

TEST(MotionSinceNodeTest, BeginsAtTheFirstReadingWhereverThatIs)
{
    MotionSinceNode motion{fild::TGraphOptions()};
    EXPECT_FALSE(motion.feed(image(0)));
    EXPECT_TRUE(motion.feed(odometry(1, {100, 50, 2})));
    EXPECT_FALSE(motion.motion());
    EXPECT_EQ(motion.timestamp(), 1);
    EXPECT_FALSE(motion.feed(image(1.5)));
    EXPECT_TRUE(motion.feed(odometry(2, CPose2D(100, 50, 2) + CPose2D(1, 0.5, 0.1))));
    ASSERT_TRUE(motion.motion());
    EXPECT_NEAR(motion.motion()->a_from_b.x(), 1, 1e-9);
    EXPECT_NEAR(motion.motion()->a_from_b.y(), 0.5, 1e-9);
    EXPECT_NEAR(motion.motion()->a_from_b.yaw(), 0.1, 1e-9);
    EXPECT_EQ(motion.timestamp(), 2);
}

TEST(MotionSinceNodeTest, IsThatOfTheWholeTrajectory)
{
    const fild::TGraphOptions options;
    MotionSinceNode motion(options);
    fild::TrajectoryBuilder whole(options);
    CPose2D pose;
    for (int i = 0; i < 10; ++i)
    {
        const auto reading = odometry(i, pose);
        motion.feed(reading);
        whole.feed(*reading);
        whole.add_frame(fild::FrameId{static_cast<std::uint64_t>(i)}, i);
        if (i == 4) motion.begin_at_node();
        pose = pose + CPose2D(1, 0.1, 0.2);
    }
    const auto expected = whole.build().motion(fild::FrameId{4}, fild::FrameId{9});
    ASSERT_TRUE(motion.motion());
    EXPECT_NEAR(motion.motion()->a_from_b.distanceTo(expected->a_from_b), 0, 1e-9);
    for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(motion.motion()->covariance(k, k), expected->covariance(k, k), 1e-9) << k;
}

TEST(MotionSinceNodeTest, ComesFromActionsToo)
{
    MotionSinceNode motion{fild::TGraphOptions()};
    for (int i = 0; i < 6; ++i)
    {
        motion.feed(fild::testing::movement_2d({0.5, 0, 0}));
        EXPECT_TRUE(motion.feed(image(i)));
        EXPECT_FALSE(motion.feed(image(i)));
        if (i == 2) motion.begin_at_node();
    }
    ASSERT_TRUE(motion.motion());
    EXPECT_NEAR(motion.motion()->a_from_b.x(), 1.5, 1e-9);
    EXPECT_EQ(motion.timestamp(), 5);
}

TEST(MotionSinceNodeTest, RefusesGps)
{
    fild::TGraphOptions options;
    options.motion_sources = "gps";
    EXPECT_THROW(MotionSinceNode{options}, std::invalid_argument);
}

TEST(MotionSinceNodeTest, RefusesAnOdometryThatWasReset)
{
    MotionSinceNode motion{fild::TGraphOptions()};
    motion.feed(odometry(1, {5, 0, 0}));
    motion.feed(odometry(2, {6, 0, 0}));
    EXPECT_THROW(motion.feed(odometry(3, {})), std::runtime_error);
}

}  // namespace
