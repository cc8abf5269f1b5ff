// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/graph_builder.h"

#include "fild/mapping/trajectory_builder.h"
#include "message_of.h"
#include "observations.h"
#include "small_graphs.h"

#include <limits>

namespace
{
using fild::build_pose_graph;
using fild::FrameId;
using fild::LoopMeasurement;
using fild::testing::message_of;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/** Ten frames half a metre apart; after frame 5 the odometry is reset. */
fild::Trajectory drive_with_reset()
{
    fild::TrajectoryBuilder builder({});
    for (int i = 0; i < 10; ++i)
    {
        builder.feed(fild::testing::odometry_at(i, CPose2D(i < 6 ? 0.5 * i : 0.5 * (i - 6), 0, 0)));
        builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    return builder.build();
}

LoopMeasurement loop(std::uint64_t candidate, std::uint64_t query)
{
    return {FrameId{candidate},
            FrameId{query},
            {CPose3D(0.1, 0, 0, 0, 0, 0), fild::testing::information_of(10, 100)}};
}

TEST(BuildPoseGraph, JoinsKeyframesOfASegmentAndLoops)
{
    const auto built = build_pose_graph(drive_with_reset(), {loop(1, 8)}, {});
    const auto& graph = built.graph;
    std::vector<std::uint64_t> frames;
    for (const auto& node : graph.nodes) frames.push_back(to_index(node.frame));
    EXPECT_THAT(frames, testing::ElementsAre(0, 1, 3, 5, 6, 8, 9));
    ASSERT_EQ(graph.odometry.size(), 5U) << "none from 5 to 6";
    EXPECT_NEAR(graph.odometry[1].a_from_b.x(), 1, 1e-9);
    EXPECT_EQ(graph.nodes[5].timestamp, 8);
    ASSERT_EQ(graph.loops.size(), 1U);
    EXPECT_NEAR(graph.loops[0].information(0, 0), 100, 1e-6);
    EXPECT_NEAR(graph.loops[0].information(3, 3), 1e4, 1e-4);
    EXPECT_EQ(connected_parts(graph).size(), 1U);
    EXPECT_EQ(connected_parts(build_pose_graph(drive_with_reset(), {}, {}).graph).size(), 2U);
}

TEST(BuildPoseGraph, TellsLoopsWithoutAPose)
{
    const auto built = build_pose_graph(drive_with_reset(), {loop(1, 50), loop(0, 5)}, {});
    ASSERT_EQ(built.loops_without_pose.size(), 1U);
    EXPECT_EQ(built.loops_without_pose[0].query, FrameId{50});
    EXPECT_EQ(built.graph.loops.size(), 1U);
}

TEST(BuildPoseGraph, RefusesSingularLoops)
{
    auto singular = loop(1, 5);
    singular.motion.covariance(4, 4) = 0;
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [&] { build_pose_graph(drive_with_reset(), {singular}, {}); }),
                HasSubstr("covariance of the loop from frame 1 to frame 5: singular"));
    singular.motion.covariance(4, 4) = std::numeric_limits<double>::infinity();
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [&] { build_pose_graph(drive_with_reset(), {singular}, {}); }),
                HasSubstr("not finite"));
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [&] { build_pose_graph(drive_with_reset(), {loop(3, 3)}, {}); }),
                HasSubstr("loop edge 3 -> 3: from a node to itself"));
}

TEST(BuildPoseGraph, OfNoPosesIsEmpty)
{
    const auto built = build_pose_graph(fild::trajectory_from_motions({}), {}, {});
    EXPECT_THAT(built.graph.nodes, IsEmpty());
}

}  // namespace
