// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/loop_selection.h"

#include "message_of.h"
#include "small_graphs.h"

namespace
{
using fild::FrameId;
using fild::LoopFate;
using fild::PoseGraph;
using fild::solve_graph;
using fild::solved_graph;
using fild::TGraphOptions;
using fild::testing::graph_of;
using fild::testing::information_of;
using fild::testing::loop_between;
using fild::testing::message_of;
using fild::testing::square_truth;
using mrpt::poses::CPose3D;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PoseGraph two_laps_and_a_false_loop()
{
    const auto truth = square_truth(2);
    auto graph = graph_of(truth);
    for (std::size_t i = 0; i < 5; ++i) graph.loops.push_back(loop_between(truth, i, i + 4));
    graph.loops.push_back({FrameId{0}, FrameId{6}, CPose3D(), information_of(0.05, 0.01)});
    return graph;
}

double distance_from_truth(const std::vector<CPose3D>& poses)
{
    const auto truth = square_truth(2);
    double largest = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        largest = std::max(largest, truth[i].distanceTo(poses.at(i)));
    return largest;
}

/** Cancels at its n-th call; n from 1. */
fild::CheckCancelled cancelled_at(int n)
{
    return [left = n]() mutable
    {
        if (--left == 0) throw std::runtime_error("interrupted");
    };
}

// Hours of loops take minutes here: the user must be able to stop the comparison of loops and the
// optimisation, wherever they are.
TEST(SolveGraph, EndsWhenItIsCancelled)
{
    const auto graph = two_laps_and_a_false_loop();
    int calls = 0;
    solve_graph(graph, TGraphOptions(), [&] { ++calls; });
    ASSERT_GT(calls, static_cast<int>(graph.loops.size()))
        << "while loops are compared, in the search for the clique, after each iteration";
    for (int n = 1; n <= calls; ++n)
        EXPECT_EQ(message_of<std::runtime_error>(
                      [&] { solve_graph(graph, TGraphOptions(), cancelled_at(n)); }),
                  "interrupted")
            << n << " of " << calls;
}

TEST(SolveGraph, TellsTheFateOfEachLoop)
{
    const auto solution = solve_graph(two_laps_and_a_false_loop(), {});
    for (std::size_t i = 0; i < 5; ++i)
    {
        EXPECT_EQ(solution.loops[i].fate, LoopFate::used) << i;
        EXPECT_EQ(solution.loops[i].weight, 1) << i;
        EXPECT_NEAR(solution.loops[i].squared_error, 0, 1e-6);
    }
    EXPECT_EQ(solution.loops[5].fate, LoopFate::against_odometry);
    EXPECT_EQ(solution.loops[5].weight, 0);
    EXPECT_GT(solution.loops[5].squared_error, 1e4);
    EXPECT_LT(distance_from_truth(solution.map_from_robot), 1e-6);
    EXPECT_EQ(solution.parts.size(), 1U);
    EXPECT_STREQ(to_word(LoopFate::against_odometry), "against_odometry");
}

TEST(SolveGraph, EachDefenceAloneSuffices)
{
    TGraphOptions options;
    options.robust_weights = false;
    EXPECT_LT(distance_from_truth(solve_graph(two_laps_and_a_false_loop(), options).map_from_robot),
              1e-6);
    options.odometry_confidence = 1;
    auto solution = solve_graph(two_laps_and_a_false_loop(), options);
    EXPECT_EQ(solution.loops[5].fate, LoopFate::against_others);
    EXPECT_LT(distance_from_truth(solution.map_from_robot), 1e-6);
    options.robust_weights = true;
    options.pairwise_consistency = false;
    solution = solve_graph(two_laps_and_a_false_loop(), options);
    EXPECT_EQ(solution.loops[5].fate, LoopFate::outlier);
    EXPECT_LT(distance_from_truth(solution.map_from_robot), 1e-3);
    options.robust_weights = false;
    EXPECT_GT(distance_from_truth(solve_graph(two_laps_and_a_false_loop(), options).map_from_robot),
              1);
}

// Two loops, each off by three deviations to another side: they disagree, and yet fit the map.
TEST(SolveGraph, TakesBackALoopThatAgreesWithTheMap)
{
    auto graph = two_laps_and_a_false_loop();
    graph.loops.pop_back();
    for (auto& edge : graph.odometry) edge.information = information_of(0.001, 0.0001);
    for (auto& edge : graph.loops) edge.information = information_of(0.05, 0.0001);
    graph.loops[0].a_from_b.x_incr(0.15);
    graph.loops[2].a_from_b.x_incr(0.15);  // the robot looks the other way there
    TGraphOptions options;
    options.pairwise_confidence = 0.99;
    const auto solution = solve_graph(graph, options);
    for (const auto& loop : solution.loops) EXPECT_EQ(loop.fate, LoopFate::used);
    EXPECT_GT(solution.optimizations, 1);
}

TEST(SolveGraph, ReportsPartsThatNoUsedLoopHolds)
{
    auto graph = two_laps_and_a_false_loop();
    graph.loops.clear();
    graph.odometry.erase(graph.odometry.begin() + 4);
    EXPECT_EQ(solve_graph(graph, {}).parts.size(), 2U);
}

TEST(SolveGraph, OfASingleKeyframeHasNothingToDo)
{
    const auto solution = solve_graph(graph_of({CPose3D(1, 0, 0, 0, 0, 0)}), {});
    ASSERT_EQ(solution.map_from_robot.size(), 1U);
    EXPECT_EQ(solution.map_from_robot[0].x(), 1);
    EXPECT_EQ(solution.optimizations, 0);
    EXPECT_THAT(solve_graph({}, {}).map_from_robot, IsEmpty());
}

TEST(SolvedGraph, HasTheLoopsThatCountTimesTheirWeight)
{
    const auto graph = two_laps_and_a_false_loop();
    auto solution = solve_graph(graph, {});
    solution.loops[1].weight = 0.5;
    const auto solved = solved_graph(graph, solution);
    ASSERT_EQ(solved.loops.size(), 5U);
    EXPECT_NEAR(solved.loops[0].information(0, 0), 400, 1e-9);
    EXPECT_NEAR(solved.loops[1].information(0, 0), 200, 1e-9);
    EXPECT_EQ(solved.nodes[3].map_from_robot, solution.map_from_robot[3]);
    solution.loops.pop_back();
    EXPECT_THAT(message_of<std::invalid_argument>([&] { solved_graph(graph, solution); }),
                HasSubstr("of another graph"));
}

}  // namespace
