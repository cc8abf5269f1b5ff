// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/cancellation.h"
#include "fild/graph/graph_options.h"
#include "fild/graph/pose_graph.h"

#include <vector>

namespace fild
{
/** What became of a loop of the graph. */
enum class LoopFate
{
    used,  ///< its weight is more than 0
    against_odometry,  ///< the odometry alone rules it out
    against_others,  ///< not in the largest set of loops that agree with each other
    outlier  ///< the rest of the graph contradicts it
};

/** The word for reports: the enumerator's name. */
const char* to_word(LoopFate fate);

/** A loop's part in the solution. Value type. */
struct LoopResult
{
    LoopFate fate = LoopFate::used;
    double weight = 0;  ///< in [0, 1]
    double squared_error = 0;  ///< Mahalanobis, against the optimised poses; chi2 with 6 degrees
};

/** A prior's part in the solution. Value type. */
struct PriorResult
{
    double weight = 0;  ///< in [0, 1]
    double squared_error = 0;  ///< Mahalanobis, against the optimised poses; chi2 with 3 degrees
};

/** An optimised graph. Value type. */
struct GraphSolution
{
    std::vector<mrpt::poses::CPose3D> map_from_robot;  ///< of each node
    std::vector<LoopResult> loops;  ///< of each loop of the graph
    std::vector<PriorResult> priors;  ///< of each prior of the graph
    /** As connected_parts() of the graph with the loops that were used: more than one, and where
     * the others lie to the first is only guessed. */
    std::vector<std::vector<FrameId>> parts;
    bool is_largest_set = true;  ///< see LoopAgreement::is_largest
    int optimizations = 0;  ///< 0: there was nothing to optimise (one node, or no edge)
};

/** Optimises a graph so that false loops do not bend it: find_consistent_loops(), then
 *  optimize_robustly() with these. A loop that was left out as against others and yet agrees with
 *  the poses found (its covariance was a little too small, say) is taken back, once, and the graph
 *  optimised again; not without TGraphOptions::robust_weights, which would catch a wrong one.
 *  Deterministic.
 *  \param check_cancelled  called as find_consistent_loops() and optimize_robustly() do.
 *  \throw std::invalid_argument on a bad graph or bad options. */
GraphSolution solve_graph(const PoseGraph& graph,
                          const TGraphOptions& options,
                          const CheckCancelled& check_cancelled = never_cancelled);

/** The graph as solved: nodes at their optimised poses, loops and priors of weight 0 left out, the
 *  information of the others times their weight. poses.graph and poses.g2o are written from it.
 *  \throw std::invalid_argument when the solution is not of this graph. */
PoseGraph solved_graph(const PoseGraph& graph, const GraphSolution& solution);

}  // namespace fild
