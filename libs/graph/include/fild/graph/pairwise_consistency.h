// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/cancellation.h"
#include "fild/graph/pose_graph.h"

#include <cstddef>
#include <vector>

namespace fild
{
/** When loops agree. Probabilities in (0, 1); of an error that a right loop stays below. */
struct AgreementLimits
{
    double pairwise = 0.99999;
    double with_odometry = 0.9999;  ///< 1: not looked at
};

/** Which loops of a graph agree, as indices into PoseGraph::loops, each in increasing order. */
struct LoopAgreement
{
    std::vector<std::size_t> consistent;
    std::vector<std::size_t> against_odometry;  ///< the odometry alone rules them out
    std::vector<std::size_t> against_others;  ///< not in the largest consistent set
    bool is_largest = true;  ///< false: the search was given up, there may be a larger set
};

/** Squared Mahalanobis distance from the identity of the cycle candidate_i -> candidate_j
 * (odometry)
 *  -> query_j (loop j) -> query_i (odometry) -> candidate_i (loop i, backwards); chi2 with 6
 *  degrees of freedom when both loops are right. To first order in the errors, which are taken as
 *  independent. \throw std::invalid_argument on a bad graph, and when the odometry does not connect
 *  candidates and queries. */
double cycle_error(const PoseGraph& graph, std::size_t loop_i, std::size_t loop_j);

/** cycle_error() of each loop with the one whose query comes next, where the odometry connects
 *  them: the two tell nearly the same, so that this shows the noise of loops. */
std::vector<double> errors_of_neighbours(const PoseGraph& graph);

/** Squared Mahalanobis distance from the identity of each loop's cycle with the odometry between
 *  its own ends, where it connects them; chi2 with 6 degrees of freedom. */
std::vector<double> errors_against_odometry(const PoseGraph& graph);

/** Pairwise consistency maximisation: the largest set of loops that agree two by two.
 *  Mangelson et al., "Pairwise consistent measurement set maximization for robust multi-robot map
 *  merging", ICRA 2018.
 *
 *  Before that, loops that disagree with the odometry between their own ends are left out: a lone
 *  false loop agrees with itself. Loops between the same two segments of the odometry (parts
 * without an edge between them) are held against each other; those between other segments are sets
 * of their own, as nothing is known of the way between. Costs the square of the number of loops,
 *  and that of largest_clique(). Deterministic.
 *  \param check_cancelled  called for each loop, and as largest_clique() does.
 *  \throw std::invalid_argument on a bad graph, or limits outside (0, 1]. */
LoopAgreement find_consistent_loops(const PoseGraph& graph,
                                    const AgreementLimits& limits,
                                    const CheckCancelled& check_cancelled = never_cancelled);

}  // namespace fild
