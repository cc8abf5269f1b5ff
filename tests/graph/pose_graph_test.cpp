// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/pose_graph.h"

#include "message_of.h"
#include "small_graphs.h"

#include <limits>

namespace
{
using fild::connected_parts;
using fild::FrameId;
using fild::PoseGraph;
using fild::testing::graph_of;
using fild::testing::loop_between;
using fild::testing::message_of;
using fild::testing::square_truth;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const double kNan = std::numeric_limits<double>::quiet_NaN();

PoseGraph square()
{
    auto graph = graph_of(square_truth());
    graph.loops.push_back(loop_between(square_truth(), 0, 4));
    return graph;
}

std::string fault_of(const PoseGraph& graph)
{
    return message_of<std::invalid_argument>([&] { graph.check(); });
}

TEST(PoseGraph, AcceptsWhatIsWellFormed)
{
    EXPECT_NO_THROW(square().check());
    EXPECT_NO_THROW(PoseGraph().check());
    EXPECT_NO_THROW(graph_of({mrpt::poses::CPose3D()}).check());
}

TEST(PoseGraph, RefusesBadInformation)
{
    auto graph = square();
    graph.loops[0].information(3, 3) = 0;
    EXPECT_THAT(fault_of(graph), HasSubstr("information of the loop edge 0 -> 4: singular"));
    graph = square();
    graph.loops[0].information(5, 5) = -1;
    EXPECT_THAT(fault_of(graph), HasSubstr("not positive definite"));
    graph = square();
    graph.odometry[1].information(2, 2) = kNan;
    EXPECT_THAT(fault_of(graph), HasSubstr("information of the odometry edge 1 -> 2: not finite"));
    graph = square();
    graph.odometry[1].information(2, 1) = 1;
    EXPECT_THAT(fault_of(graph), HasSubstr("not symmetric"));
    graph = square();
    graph.loops[0].information.setZero();
    EXPECT_THAT(fault_of(graph), HasSubstr("singular"));
}

// Variances of very different size are no singularity.
TEST(PoseGraph, AcceptsInformationOfAnyScale)
{
    auto graph = square();
    graph.loops[0].information(0, 0) = 1e10;
    graph.loops[0].information(5, 5) = 1e-4;
    EXPECT_NO_THROW(graph.check());
}

TEST(PoseGraph, RefusesBadPoses)
{
    auto graph = square();
    graph.nodes[2].map_from_robot.x(kNan);
    EXPECT_THAT(fault_of(graph), HasSubstr("node 2: the pose is not finite"));
    graph = square();
    graph.loops[0].a_from_b.y(std::numeric_limits<double>::infinity());
    EXPECT_THAT(fault_of(graph), HasSubstr("loop edge 0 -> 4: the pose is not finite"));
    graph = square();
    graph.loops[0].a_from_b = mrpt::poses::CPose3D(0, 0, 0, 0, 90 * fild::kRadiansPerDegree, 0);
    EXPECT_THAT(fault_of(graph), HasSubstr("the pitch is 90 degrees"));
}

TEST(PoseGraph, RefusesEdgesThatLeadNowhere)
{
    auto graph = square();
    graph.loops[0].b = FrameId{9};
    EXPECT_THAT(fault_of(graph), HasSubstr("no node for frame 9"));
    graph.loops[0].b = FrameId{0};
    EXPECT_THAT(fault_of(graph), HasSubstr("loop edge 0 -> 0: from a node to itself"));
    graph = square();
    graph.odometry[0].b = FrameId{2};
    EXPECT_THAT(fault_of(graph), HasSubstr("odometry edge 0 -> 2: not from a node to the next"));
    graph = square();
    std::swap(graph.nodes[0], graph.nodes[1]);
    EXPECT_THAT(fault_of(graph), HasSubstr("node 0 comes after node 1"));
}

TEST(PoseGraph, KnowsItsParts)
{
    auto graph = graph_of(square_truth());
    EXPECT_EQ(connected_parts(graph).size(), 1U);
    graph.odometry.erase(graph.odometry.begin() + 1);  // from node 1 to node 2
    const auto parts = connected_parts(graph);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_THAT(parts[0], ElementsAre(FrameId{2}, FrameId{3}, FrameId{4}));
    EXPECT_THAT(parts[1], ElementsAre(FrameId{0}, FrameId{1}));
    graph.loops.push_back(loop_between(square_truth(), 0, 4));
    EXPECT_EQ(connected_parts(graph).size(), 1U);
    EXPECT_THAT(connected_parts(PoseGraph()), IsEmpty());
}

TEST(PoseGraph, PartOfItHasItsEdges)
{
    const auto part = part_of(square(), {FrameId{0}, FrameId{1}, FrameId{4}});
    EXPECT_EQ(part.nodes.size(), 3U);
    EXPECT_EQ(part.odometry.size(), 1U);
    EXPECT_EQ(part.loops.size(), 1U);
    EXPECT_THROW(part_of(square(), {FrameId{7}}), std::invalid_argument);
}

TEST(ConnectedParts, AreHeldTogetherByPriorsToo)
{
    auto graph = fild::testing::graph_of(fild::testing::square_truth());
    graph.odometry.erase(graph.odometry.begin() + 1);
    ASSERT_EQ(connected_parts(graph).size(), 2U);
    for (const auto& node : {graph.nodes.front(), graph.nodes.back()})
    {
        fild::GraphPrior prior{node.frame, {}, {}, {}};
        prior.information.setDiagonal(3, 1);
        graph.priors.push_back(prior);
    }
    graph.check();
    EXPECT_EQ(connected_parts(graph).size(), 1U);
    EXPECT_EQ(part_of(graph, {graph.nodes.front().frame}).priors.size(), 1U);
}

TEST(PoseGraph, RefusesBadPriors)
{
    auto graph = fild::testing::graph_of(fild::testing::square_truth());
    graph.priors.push_back({FrameId{0}, {}, {}, {}});
    EXPECT_THAT(message_of<std::invalid_argument>([&] { graph.check(); }),
                HasSubstr("prior of node 0: information is not positive definite"));
    graph.priors.back().information.setDiagonal(3, 1);
    graph.priors.back().map_from_point.x = std::nan("");
    EXPECT_THAT(message_of<std::invalid_argument>([&] { graph.check(); }), HasSubstr("not finite"));
    graph.priors.back() = {FrameId{99}, {}, {}, graph.priors.back().information};
    EXPECT_THROW(graph.check(), std::invalid_argument);
}

}  // namespace
