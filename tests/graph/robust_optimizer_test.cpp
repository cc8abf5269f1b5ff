// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/robust_optimizer.h"

#include "message_of.h"
#include "random_poses.h"
#include "small_graphs.h"

#include <mrpt/math/TPose3D.h>

namespace
{
using fild::optimize;
using fild::optimize_robustly;
using fild::PoseGraph;
using fild::testing::graph_of;
using fild::testing::information_of;
using fild::testing::loop_between;
using fild::testing::message_of;
using fild::testing::random_information;
using fild::testing::random_pose;
using fild::testing::square_truth;
using mrpt::poses::CPose3D;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void expect_poses(const std::vector<CPose3D>& poses,
                  const std::vector<CPose3D>& expected,
                  double tolerance)
{
    ASSERT_EQ(poses.size(), expected.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
        const CPose3D off = poses[i] - expected[i];
        EXPECT_LT(off.norm(), tolerance) << "node " << i << ": " << poses[i];
        EXPECT_LT(std::abs(off.yaw()) + std::abs(off.pitch()) + std::abs(off.roll()), tolerance);
    }
}

// To first order, the error is the Mahalanobis distance in MRPT's parameters.
TEST(SquaredError, IsMrptsMahalanobisDistance)
{
    constexpr double kSmall = 1e-4;
    std::mt19937_64 generator(1);
    for (int n = 0; n < 20; ++n)
    {
        const auto a = random_pose(generator);
        const auto a_from_b = random_pose(generator);
        const auto information = random_information(generator);
        mrpt::math::CVectorFixedDouble<6> d;
        for (int i = 0; i < 6; ++i) d[i] = kSmall * fild::standard_normal(generator);
        const CPose3D moved(a_from_b.x() + d[0],
                            a_from_b.y() + d[1],
                            a_from_b.z() + d[2],
                            a_from_b.yaw() + d[3],
                            a_from_b.pitch() + d[4],
                            a_from_b.roll() + d[5]);
        double expected = 0;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) expected += d[i] * information(i, j) * d[j];
        const double error = fild::squared_error(
            {fild::FrameId{0}, fild::FrameId{1}, a_from_b, information}, a, a + moved);
        EXPECT_NEAR(error / expected, 1, 0.01);
    }
}

TEST(Optimize, LeavesAnExactGraphAsItIs)
{
    auto graph = graph_of(square_truth());
    graph.loops.push_back(loop_between(square_truth(), 0, 4));
    const auto result = optimize(graph, {1}, {});
    expect_poses(result.map_from_robot, square_truth(), 1e-9);
    EXPECT_NEAR(result.loop_errors[0], 0, 1e-9);
}

TEST(Optimize, FindsTheSquareFromABadGuess)
{
    auto graph = graph_of(square_truth());
    graph.loops.push_back(loop_between(square_truth(), 0, 4));
    std::mt19937_64 generator(2);
    for (std::size_t i = 1; i < graph.nodes.size(); ++i)
        graph.nodes[i].map_from_robot =
            graph.nodes[i].map_from_robot + CPose3D(fild::standard_normal(generator),
                                                    fild::standard_normal(generator),
                                                    0.5,
                                                    0.2,
                                                    -0.1,
                                                    0.1);
    expect_poses(optimize(graph, {1}, {}).map_from_robot, square_truth(), 1e-5);
}

// Along a line all is linear: two measurements of the same metre meet by their information.
TEST(Optimize, HonoursInformation)
{
    auto graph = graph_of({CPose3D(), CPose3D(1, 0, 0, 0, 0, 0)});
    graph.odometry[0].information = information_of(1, 0.1);
    graph.loops.push_back(
        {fild::FrameId{0}, fild::FrameId{1}, CPose3D(2, 0, 0, 0, 0, 0), information_of(0.5, 0.1)});
    EXPECT_NEAR(optimize(graph, {1}, {}).map_from_robot[1].x(), (1 * 1 + 4 * 2) / 5.0, 1e-7);
    EXPECT_NEAR(optimize(graph, {0.25}, {}).map_from_robot[1].x(), 1.5, 1e-7);
    EXPECT_NEAR(optimize(graph, {0}, {}).map_from_robot[1].x(), 1, 1e-9);
}

// A drift in yaw of 0.02 rad a side: the square closes, and each corner takes its quarter.
TEST(Optimize, SpreadsTheDriftOfASquare)
{
    const auto truth = square_truth();
    auto graph = graph_of(truth);
    const CPose3D drifting(10, 0, 0, 90 * fild::kRadiansPerDegree + 0.02, 0, 0);
    for (auto& edge : graph.odometry) edge.a_from_b = drifting;
    for (std::size_t i = 1; i < graph.nodes.size(); ++i)
        graph.nodes[i].map_from_robot = graph.nodes[i - 1].map_from_robot + drifting;
    graph.loops.push_back(loop_between(truth, 0, 4));
    graph.loops[0].information = information_of(1e-4, 1e-5);
    const auto poses = optimize(graph, {1}, {}).map_from_robot;
    expect_poses({poses[4]}, {truth[4]}, 1e-3);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR((poses[i + 1] - poses[i]).yaw(), 90 * fild::kRadiansPerDegree, 5e-3);
    EXPECT_NEAR(poses[2].distanceTo(poses[0]), 10 * std::sqrt(2.0), 0.1);
}

TEST(Optimize, KeepsTheFirstNodeOfEachPart)
{
    auto graph = graph_of(square_truth());
    graph.odometry.erase(graph.odometry.begin() + 1);
    graph.odometry[1].a_from_b = CPose3D(11, 0, 0, 0, 0, 0);
    const auto poses = optimize(graph, {}, {}).map_from_robot;
    expect_poses({poses[0], poses[2]}, {square_truth()[0], square_truth()[2]}, 1e-12);
    EXPECT_NEAR(poses[3].distanceTo(poses[2]), 11, 1e-6);
}

TEST(Optimize, OfOneNodeOrNoneDoesNothing)
{
    EXPECT_THAT(optimize({}, {}, {}).map_from_robot, IsEmpty());
    const auto one = optimize(graph_of({CPose3D(1, 2, 3, 0, 0, 0)}), {}, {});
    EXPECT_NEAR(one.map_from_robot.at(0).y(), 2, 1e-12);
}

/** Two laps with the four true loops of each corner. */
PoseGraph two_laps()
{
    const auto truth = square_truth(2);
    auto graph = graph_of(truth);
    for (std::size_t i = 0; i < 5; ++i) graph.loops.push_back(loop_between(truth, i, i + 4));
    return graph;
}

TEST(OptimizeRobustly, GivesRightLoopsFullWeight)
{
    const auto result = optimize_robustly(two_laps(), std::vector<bool>(5, true), {});
    EXPECT_THAT(result.loop_weights, Each(1));
    expect_poses(result.map_from_robot, square_truth(2), 1e-6);
}

TEST(OptimizeRobustly, TakesTheWeightOfWrongLoops)
{
    const auto truth = square_truth(2);
    auto graph = two_laps();
    graph.loops.push_back(
        {fild::FrameId{0}, fild::FrameId{6}, CPose3D(), information_of(0.05, 0.01)});
    graph.loops.push_back(
        {fild::FrameId{1}, fild::FrameId{7}, CPose3D(), information_of(0.05, 0.01)});
    const auto result = optimize_robustly(graph, std::vector<bool>(7, true), {});
    EXPECT_THAT(result.loop_weights, ElementsAre(1, 1, 1, 1, 1, 0, 0));
    expect_poses(result.map_from_robot, truth, 1e-3);
    EXPECT_GT(result.loop_errors[5], 1e4);
}

TEST(OptimizeRobustly, LeavesOutWhatIsNoCandidate)
{
    const auto result = optimize_robustly(two_laps(), {true, false, true, true, false}, {});
    EXPECT_THAT(result.loop_weights, ElementsAre(1, 0, 1, 1, 0));
}

TEST(OptimizeRobustly, GivesTheSameEachTime)
{
    auto graph = two_laps();
    graph.loops.push_back(
        {fild::FrameId{0}, fild::FrameId{6}, CPose3D(), information_of(0.05, 0.01)});
    const auto one = optimize_robustly(graph, std::vector<bool>(6, true), {});
    const auto two = optimize_robustly(graph, std::vector<bool>(6, true), {});
    for (std::size_t i = 0; i < one.map_from_robot.size(); ++i)
        EXPECT_EQ(one.map_from_robot[i].asTPose(), two.map_from_robot[i].asTPose());
}

TEST(Optimize, RefusesBadArguments)
{
    EXPECT_THAT(message_of<std::invalid_argument>([] { optimize(two_laps(), {1}, {}); }),
                HasSubstr("1 loop weights for 5 loops"));
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] {
                        optimize(two_laps(), {1, 1, 1, 1, 2}, {});
                    }),
                HasSubstr("outside [0, 1]"));
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] {
                        optimize(two_laps(), std::vector<double>(5, 1), {0, 0.99});
                    }),
                HasSubstr("max_iterations=0"));
    EXPECT_THAT(message_of<std::invalid_argument>(
                    [] {
                        optimize_robustly(two_laps(), std::vector<bool>(5, true), {50, 1});
                    }),
                HasSubstr("loop_confidence=1"));
}

/** What a receiver measures whose antenna is half a metre before and two metres over the robot. */
fild::GraphPrior prior_at(std::size_t node, const CPose3D& map_from_robot, double sigma)
{
    const mrpt::math::TPoint3D antenna(0.5, 0, 2);
    fild::GraphPrior prior{fild::FrameId{node}, map_from_robot.composePoint(antenna), antenna, {}};
    prior.information.setDiagonal(3, 1 / (sigma * sigma));
    return prior;
}

/** Where the map's axes put the square. */
std::vector<CPose3D> square_elsewhere(std::size_t laps)
{
    auto poses = square_truth(laps);
    for (auto& pose : poses) pose = CPose3D(100, 50, 3, 0.7, 0, 0) + pose;
    return poses;
}

/** The square by its odometry, and where a receiver says that it is. */
PoseGraph square_with_priors(double sigma, std::size_t laps)
{
    auto graph = graph_of(square_truth(laps));
    const auto truth = square_elsewhere(laps);
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
        graph.priors.push_back(prior_at(i, truth[i], sigma));
    return graph;
}

TEST(Optimize, TakesTheMapToWhereThePriorsSay)
{
    auto graph = square_with_priors(0.001, 1);
    for (auto& edge : graph.odometry)  // it turns too little
        edge.a_from_b = CPose3D(edge.a_from_b.x(), 0, 0, 0.9 * edge.a_from_b.yaw(), 0, 0);
    const auto result = optimize(graph, {}, {});
    for (std::size_t i = 0; i < graph.priors.size(); ++i)
    {
        const auto& prior = graph.priors[i];
        const auto antenna = result.map_from_robot[i].composePoint(prior.robot_from_point);
        EXPECT_LT((antenna - prior.map_from_point).norm(), 0.01) << i;
        EXPECT_EQ(result.prior_weights[i], 1);
        EXPECT_NEAR(result.prior_errors[i],
                    fild::squared_error(prior, result.map_from_robot[i]),
                    1e-6 + 1e-6 * result.prior_errors[i]);
    }
}

TEST(OptimizeRobustly, LetsGoOfPriorsThatTheOthersContradict)
{
    constexpr std::size_t kLaps = 4;
    auto graph = square_with_priors(0.05, kLaps);
    for (const std::size_t wrong : {2, 7, 8}) graph.priors[wrong].map_from_point.x += 30;
    const auto result = optimize_robustly(graph, {}, {});
    for (std::size_t i = 0; i < graph.priors.size(); ++i)
        EXPECT_EQ(result.prior_weights[i], i == 2 || i == 7 || i == 8 ? 0 : 1) << i;
    expect_poses(result.map_from_robot, square_elsewhere(kLaps), 0.01);
}

}  // namespace
