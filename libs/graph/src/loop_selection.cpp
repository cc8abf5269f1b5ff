// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/loop_selection.h"

#include "fild/graph/pairwise_consistency.h"
#include "fild/graph/robust_optimizer.h"

#include <mrpt/math/distributions.h>

#include <stdexcept>

namespace fild
{
namespace
{
/** The fate of each loop before the graph is optimised. */
std::vector<LoopFate> first_fates(const PoseGraph& graph,
                                  const TGraphOptions& options,
                                  const CheckCancelled& check_cancelled,
                                  bool& is_largest_set)
{
    std::vector<LoopFate> fates(graph.loops.size(), LoopFate::used);
    if (!options.pairwise_consistency) return fates;
    const auto agreement = find_consistent_loops(
        graph, {options.pairwise_confidence, options.odometry_confidence}, check_cancelled);
    for (const auto i : agreement.against_odometry) fates[i] = LoopFate::against_odometry;
    for (const auto i : agreement.against_others) fates[i] = LoopFate::against_others;
    is_largest_set = agreement.is_largest;
    return fates;
}

OptimizedPoses optimize_used(const PoseGraph& graph,
                             const std::vector<LoopFate>& fates,
                             const TGraphOptions& options,
                             const CheckCancelled& check_cancelled)
{
    const OptimizationLimits limits{options.max_iterations, options.loop_confidence};
    std::vector<bool> used;
    used.reserve(fates.size());
    for (const auto fate : fates) used.push_back(fate == LoopFate::used);
    if (options.robust_weights) return optimize_robustly(graph, used, limits, check_cancelled);
    return optimize(graph, {used.begin(), used.end()}, limits, check_cancelled);
}

/** Takes loops back that agree with the poses; false when there is none. */
bool take_back(const OptimizedPoses& poses, double limit, std::vector<LoopFate>& fates)
{
    bool any = false;
    for (std::size_t i = 0; i < fates.size(); ++i)
    {
        if (fates[i] != LoopFate::against_others || poses.loop_errors[i] > limit) continue;
        fates[i] = LoopFate::used;
        any = true;
    }
    return any;
}

GraphSolution to_solution(OptimizedPoses poses, const std::vector<LoopFate>& fates)
{
    GraphSolution solution;
    solution.map_from_robot = std::move(poses.map_from_robot);
    solution.optimizations = poses.optimizations;
    for (std::size_t i = 0; i < fates.size(); ++i)
    {
        const double weight = poses.loop_weights[i];
        const bool is_outlier = fates[i] == LoopFate::used && weight == 0;
        solution.loops.push_back(
            {is_outlier ? LoopFate::outlier : fates[i], weight, poses.loop_errors[i]});
    }
    for (std::size_t i = 0; i < poses.prior_weights.size(); ++i)
        solution.priors.push_back({poses.prior_weights[i], poses.prior_errors[i]});
    return solution;
}
}  // namespace

const char* to_word(LoopFate fate)
{
    switch (fate)
    {
        case LoopFate::against_odometry:
            return "against_odometry";
        case LoopFate::against_others:
            return "against_others";
        case LoopFate::outlier:
            return "outlier";
        default:
            return "used";
    }
}

GraphSolution solve_graph(const PoseGraph& graph,
                          const TGraphOptions& options,
                          const CheckCancelled& check_cancelled)
{
    options.check();
    graph.check();
    bool is_largest_set = true;
    auto fates = first_fates(graph, options, check_cancelled, is_largest_set);
    auto poses = optimize_used(graph, fates, options, check_cancelled);
    const double limit = mrpt::math::chi2inv(options.loop_confidence, 6);
    if (options.robust_weights && take_back(poses, limit, fates))
    {
        const int before = poses.optimizations;
        poses = optimize_used(graph, fates, options, check_cancelled);
        poses.optimizations += before;
    }
    auto solution = to_solution(std::move(poses), fates);
    solution.is_largest_set = is_largest_set;
    if (graph.odometry.empty() && graph.loops.empty() && graph.priors.empty())
        solution.optimizations = 0;
    solution.parts = connected_parts(solved_graph(graph, solution));
    return solution;
}

PoseGraph solved_graph(const PoseGraph& graph, const GraphSolution& solution)
{
    if (solution.map_from_robot.size() != graph.nodes.size() ||
        solution.loops.size() != graph.loops.size() ||
        solution.priors.size() != graph.priors.size())
        throw std::invalid_argument("solved_graph: the solution is of another graph");
    PoseGraph solved{graph.nodes, graph.odometry, {}, {}};
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
        solved.nodes[i].map_from_robot = solution.map_from_robot[i];
    for (std::size_t i = 0; i < graph.loops.size(); ++i)
    {
        if (!(solution.loops[i].weight > 0)) continue;
        solved.loops.push_back(graph.loops[i]);
        solved.loops.back().information *= solution.loops[i].weight;
    }
    for (std::size_t i = 0; i < graph.priors.size(); ++i)
    {
        if (!(solution.priors[i].weight > 0)) continue;
        solved.priors.push_back(graph.priors[i]);
        solved.priors.back().information *= solution.priors[i].weight;
    }
    return solved;
}

}  // namespace fild
