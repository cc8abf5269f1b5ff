// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/frame_poses.h"

#include "fild/graph/graph_builder.h"
#include "fild/mapping/trajectory_builder.h"
#include "observations.h"

#include <gtest/gtest.h>

namespace
{
using fild::corrected_poses;
using fild::FrameId;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

/** Frames 0 to 8, a metre apart along x. */
fild::Trajectory line()
{
    fild::TrajectoryBuilder builder({});
    for (int i = 0; i < 9; ++i)
    {
        builder.feed(fild::testing::odometry_at(i, CPose2D(i, 0, 0)));
        builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    return builder.build();
}

/** Keyframes 0, 4 and 8. */
fild::PoseGraph keyframes_of_line()
{
    fild::TGraphOptions options;
    options.keyframe_distance_m = 4;
    return fild::build_pose_graph(line(), {}, options).graph;
}

TEST(CorrectedPoses, AreTheOldOnesWhenNothingMoved)
{
    const auto poses = corrected_poses(line(), keyframes_of_line());
    ASSERT_EQ(poses.size(), 9U);
    for (std::size_t i = 0; i < 9; ++i)
    {
        EXPECT_NEAR(poses[i].map_from_robot.x(), static_cast<double>(i), 1e-9);
        EXPECT_EQ(poses[i].timestamp, static_cast<double>(i));
    }
}

TEST(CorrectedPoses, SpreadTheCorrectionBetweenKeyframes)
{
    auto graph = keyframes_of_line();
    graph.nodes[1].map_from_robot = CPose3D(4, 2, 0, 0, 0, 0);
    graph.nodes[2].map_from_robot = CPose3D(8, 2, 0, 0, 0, 0);
    const auto poses = corrected_poses(line(), graph);
    EXPECT_NEAR(poses[1].map_from_robot.y(), 0.5, 1e-9);
    EXPECT_NEAR(poses[2].map_from_robot.y(), 1, 1e-9);
    EXPECT_NEAR(poses[4].map_from_robot.y(), 2, 1e-9);
    EXPECT_NEAR(poses[6].map_from_robot.y(), 2, 1e-9);
    EXPECT_NEAR(poses[6].map_from_robot.x(), 6, 1e-9);
}

TEST(CorrectedPoses, FollowTheLastKeyframe)
{
    auto graph = keyframes_of_line();
    graph.nodes.pop_back();
    graph.nodes.erase(graph.nodes.begin());
    graph.nodes[0].map_from_robot = CPose3D(4, 0, 0, 90 * 0.017453292519943295, 0, 0);
    const auto poses = corrected_poses(line(), graph);
    EXPECT_NEAR(poses[6].map_from_robot.x(), 4, 1e-9);
    EXPECT_NEAR(poses[6].map_from_robot.y(), 2, 1e-9);
    EXPECT_NEAR(poses[1].map_from_robot.y(), -3, 1e-9);
    graph.nodes.clear();
    EXPECT_NEAR(corrected_poses(line(), graph)[3].map_from_robot.x(), 3, 1e-9);
}

}  // namespace
