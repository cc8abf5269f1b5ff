// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/pairwise_consistency.h"

#include "message_of.h"
#include "random_poses.h"
#include "small_graphs.h"

#include <mrpt/math/distributions.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

namespace
{
using fild::AgreementLimits;
using fild::cycle_error;
using fild::find_consistent_loops;
using fild::FrameId;
using fild::PoseGraph;
using fild::testing::graph_of;
using fild::testing::information_of;
using fild::testing::loop_between;
using fild::testing::message_of;
using fild::testing::square_truth;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

fild::GraphEdge wrong_loop(std::size_t a, std::size_t b, const CPose3D& a_from_b = CPose3D())
{
    return {FrameId{a}, FrameId{b}, a_from_b, information_of(0.05, 0.01)};
}

/** Two laps with true loops at the corners 0 to 4. */
PoseGraph two_laps()
{
    const auto truth = square_truth(2);
    auto graph = graph_of(truth);
    for (std::size_t i = 0; i < 5; ++i) graph.loops.push_back(loop_between(truth, i, i + 4));
    return graph;
}

TEST(CycleError, IsNoneWhereAllIsExact)
{
    const auto graph = two_laps();
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(cycle_error(graph, i, j), 0, 1e-6);
}

// Along a line, variances add up: two loops of variance 4 and two ways of 2 and 3 edges of
// variance 1.
TEST(CycleError, CountsTheVariancesOfTheWholeCycle)
{
    std::vector<CPose3D> line;
    line.reserve(10);
    for (int i = 0; i < 10; ++i) line.emplace_back(i, 0, 0, 0, 0, 0);
    auto graph = graph_of(line);
    for (auto& edge : graph.odometry) edge.information = information_of(1, 1e-6);
    graph.loops.push_back(
        {FrameId{0}, FrameId{9}, CPose3D(9, 0, 0, 0, 0, 0), information_of(2, 1e-6)});
    graph.loops.push_back(
        {FrameId{2}, FrameId{6}, CPose3D(7, 0, 0, 0, 0, 0), information_of(2, 1e-6)});
    EXPECT_NEAR(cycle_error(graph, 0, 1), 9 / (4 + 4 + 2 + 3.0), 1e-6);
    EXPECT_NEAR(cycle_error(graph, 1, 0), 9 / (4 + 4 + 2 + 3.0), 1e-6);
    const auto neighbours = fild::errors_of_neighbours(graph);
    ASSERT_EQ(neighbours.size(), 1U);
    EXPECT_NEAR(neighbours[0], 9 / (4 + 4 + 2 + 3.0), 1e-6);
    const auto against_odometry = fild::errors_against_odometry(graph);
    ASSERT_EQ(against_odometry.size(), 2U);
    EXPECT_NEAR(against_odometry[0], 0, 1e-6);
    EXPECT_NEAR(against_odometry[1], 9 / (4 + 4.0), 1e-6);
    graph.odometry.erase(graph.odometry.begin() + 4);
    EXPECT_EQ(fild::errors_of_neighbours(graph).size(), 1U) << "their ways do not cross the gap";
    EXPECT_THAT(fild::errors_against_odometry(graph), IsEmpty());
}

/** A cycle's error by MRPT's own composition of uncertain poses. */
double mrpts_cycle_error(const PoseGraph& graph)
{
    const auto pdf = [](const fild::GraphEdge& edge)
    { return CPose3DPDFGaussian(edge.a_from_b, edge.information.inverse_LLt()); };
    const auto to_candidate = -pdf(graph.loops[0]);
    const auto cycle =
        to_candidate + pdf(graph.odometry[0]) + pdf(graph.loops[1]) + pdf(graph.odometry[2]);
    const auto& mean = cycle.mean;
    const std::array<double, 6> error{
        mean.x(), mean.y(), mean.z(), mean.yaw(), mean.pitch(), mean.roll()};
    const auto information = cycle.cov.inverse_LLt();
    double squared = 0;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            squared += error.at(static_cast<std::size_t>(i)) * information(i, j) *
                       error.at(static_cast<std::size_t>(j));
    return squared;
}

TEST(CycleError, IsThatOfMrptsUncertainPoses)
{
    std::mt19937_64 generator(4);
    for (int n = 0; n < 10; ++n)
    {
        std::vector<CPose3D> poses;
        poses.reserve(4);
        for (int i = 0; i < 4; ++i) poses.push_back(fild::testing::moderate_pose(generator));
        auto graph = graph_of(poses);
        const auto add_error = [&](const CPose3D& pose)
        {
            constexpr double kError = 1e-3;
            return CPose3D(pose.x() + kError * fild::standard_normal(generator),
                           pose.y(),
                           pose.z() + kError,
                           pose.yaw() + kError * fild::standard_normal(generator),
                           pose.pitch(),
                           pose.roll() - kError);
        };
        graph.loops.push_back(loop_between(poses, 0, 3));
        graph.loops.push_back(loop_between(poses, 1, 2));
        for (auto* edges : {&graph.odometry, &graph.loops})
            for (auto& edge : *edges)
            {
                edge.a_from_b = add_error(edge.a_from_b);
                edge.information = fild::testing::random_information(generator);
                edge.information *= 1e4;
            }
        const double ours = cycle_error(graph, 0, 1);
        EXPECT_NEAR(ours / mrpts_cycle_error(graph), 1, 0.02) << n;
    }
}

TEST(ConsistentLoops, AreAllWhenAllAreRight)
{
    const auto agreement = find_consistent_loops(two_laps(), {});
    EXPECT_THAT(agreement.consistent, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(agreement.against_odometry, IsEmpty());
    EXPECT_TRUE(agreement.is_largest);
    EXPECT_THAT(find_consistent_loops(graph_of(square_truth()), {}).consistent, IsEmpty());
}

TEST(ConsistentLoops, LeaveOutTheOneThatTheOdometryRulesOut)
{
    auto graph = two_laps();
    graph.loops.insert(graph.loops.begin() + 1, wrong_loop(0, 6));
    auto agreement = find_consistent_loops(graph, {});
    EXPECT_THAT(agreement.against_odometry, ElementsAre(1));
    EXPECT_THAT(agreement.consistent, ElementsAre(0, 2, 3, 4, 5));
    agreement = find_consistent_loops(graph, {0.99999, 1});
    EXPECT_THAT(agreement.against_odometry, IsEmpty());
    EXPECT_THAT(agreement.against_others, ElementsAre(1));
}

// Three false loops agree with each other, but five true ones are more.
TEST(ConsistentLoops, AreTheLargestSetAmongSeveral)
{
    auto graph = two_laps();
    const auto truth = square_truth(2);
    const CPose3D shift(3, 0, 0, 0, 0, 0);
    for (std::size_t i = 1; i < 4; ++i)
    {
        auto edge = loop_between(truth, i, i + 4);
        // All of lap two lies 3 m further along x of the map.
        edge.a_from_b = (shift + truth[i + 4]) - truth[i];
        graph.loops.push_back(edge);
    }
    auto agreement = find_consistent_loops(graph, {0.99999, 1});
    EXPECT_THAT(agreement.consistent, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(agreement.against_others, ElementsAre(5, 6, 7));
    graph.loops.erase(graph.loops.begin(), graph.loops.begin() + 3);
    agreement = find_consistent_loops(graph, {0.99999, 1});
    EXPECT_THAT(agreement.consistent, ElementsAre(2, 3, 4)) << "now the false ones are more";
}

// With no odometry from lap one to lap two, nothing but the loops tells where they lie.
TEST(ConsistentLoops, OfOtherSegmentsAreSetsOfTheirOwn)
{
    auto graph = two_laps();
    graph.odometry.erase(graph.odometry.begin() + 4);  // from node 4 to node 5
    graph.loops.push_back(wrong_loop(1, 6));
    graph.loops.push_back(wrong_loop(5, 8));
    const auto agreement = find_consistent_loops(graph, {});
    EXPECT_THAT(agreement.consistent, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(agreement.against_others, ElementsAre(5));
    EXPECT_THAT(agreement.against_odometry, ElementsAre(6));
    EXPECT_THAT(message_of<std::invalid_argument>([&] { cycle_error(graph, 0, 1); }),
                HasSubstr("no odometry connects"));
}

TEST(ConsistentLoops, RefuseLimitsThatAreNoProbabilities)
{
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] {
                        find_consistent_loops(two_laps(), {0, 1});
                    }),
                HasSubstr("pairwise=0"));
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] {
                        find_consistent_loops(two_laps(), {0.9, 1.1});
                    }),
                HasSubstr("with_odometry=1.1"));
}

// MRPT's chi2inv is an approximation: within 3 % of the tables, on the lenient side.
TEST(ConsistentLoops, LimitsAreQuantilesOfChi2)
{
    EXPECT_NEAR(mrpt::math::chi2inv(0.99, 6), 16.81, 0.5);
    EXPECT_NEAR(mrpt::math::chi2inv(0.999, 6), 22.46, 0.7);
    EXPECT_NEAR(mrpt::math::chi2inv(0.99999, 6), 33.11, 1);
}

}  // namespace
