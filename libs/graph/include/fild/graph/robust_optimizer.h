// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/cancellation.h"
#include "fild/graph/pose_graph.h"

#include <vector>

namespace fild
{
/** A graph's poses after an optimisation. Value type. */
struct OptimizedPoses
{
    std::vector<mrpt::poses::CPose3D> map_from_robot;  ///< of each node
    std::vector<double> loop_weights;  ///< of each loop, in [0, 1]
    std::vector<double> loop_errors;  ///< of each loop: squared Mahalanobis distance, unweighted
    std::vector<double> prior_weights;  ///< of each prior, in [0, 1]
    std::vector<double> prior_errors;  ///< of each prior, as of loops
    int optimizations = 0;  ///< least-squares problems that were solved
};

/** How an optimisation runs. */
struct OptimizationLimits
{
    int max_iterations = 50;  ///< of one least-squares problem
    /** Quantile of chi2 up to which a loop (6 degrees of freedom) and a prior (3) is fully trusted.
     *  */
    double loop_confidence = 0.999;
};

/** Squared Mahalanobis distance of an edge's measurement from what two poses say: that of the error
 *  in translation and rotation vector, which is to first order that of MRPT's parameters. */
double squared_error(const GraphEdge& edge,
                     const mrpt::poses::CPose3D& map_from_a,
                     const mrpt::poses::CPose3D& map_from_b);

/** Squared Mahalanobis distance of a prior from what a pose says. */
double squared_error(const GraphPrior& prior, const mrpt::poses::CPose3D& map_from_robot);

/** Least squares over all edges and priors, each with its information matrix, loops also with their
 *  weight; a loop of weight 0 takes no part. The first node of each part without a prior that edges
 *  connect, whatever the loops' weights become, stays where it is. Levenberg-Marquardt (Ceres), one
 *  thread: deterministic.
 *  \param check_cancelled  called after each iteration.
 *  \throw std::invalid_argument on a bad graph or weights that are not one a loop, in [0, 1].
 *  \throw std::runtime_error when Ceres finds no solution. */
OptimizedPoses optimize(const PoseGraph& graph,
                        const std::vector<double>& loop_weights,
                        const OptimizationLimits& limits,
                        const CheckCancelled& check_cancelled = never_cancelled);

/** The same, with weights that are found on the way: graduated non-convexity over the loops and the
 *  priors, with truncated least squares. Yang et al., "Graduated non-convexity for robust spatial
 *  perception", RA-L 2020, GNC-TLS, Eqs. (12) to (14); the odometry always counts in full.
 *  \param candidates  for each loop whether it may count; others have weight 0 throughout. */
OptimizedPoses optimize_robustly(const PoseGraph& graph,
                                 const std::vector<bool>& candidates,
                                 const OptimizationLimits& limits,
                                 const CheckCancelled& check_cancelled = never_cancelled);

}  // namespace fild
