// SPDX-License-Identifier: BSD-3-Clause
// Pairwise consistency maximisation (Mangelson et al., ICRA 2018).
#include "fild/graph/pairwise_consistency.h"

#include "fild/graph/max_clique.h"
#include "fild/graph/uncertain_motion.h"
#include "information.h"

#include <mrpt/math/distributions.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
UncertainMotion motion_of(const GraphEdge& edge)
{
    const Matrix6 information = information_in_tangent(edge.a_from_b, edge.information, "edge");
    return {to_rigid(edge.a_from_b), information.ldlt().solve(Matrix6::Identity())};
}

/** The odometry from the first node of each segment on; motions between any two of a segment. */
class OdometryChain
{
 public:
    explicit OdometryChain(const PoseGraph& graph) : nodes_(graph.nodes.size())
    {
        std::vector<const GraphEdge*> to_node(graph.nodes.size(), nullptr);
        for (const auto& edge : graph.odometry) to_node[graph.index_of(edge.b)] = &edge;
        for (std::size_t i = 1; i < nodes_.size(); ++i)
        {
            if (to_node[i] == nullptr)
                nodes_[i].segment = nodes_[i - 1].segment + 1;
            else
                nodes_[i] = advanced(nodes_[i - 1], motion_of(*to_node[i]));
        }
    }

    int segment(std::size_t node) const { return nodes_[node].segment; }

    /** Both nodes are of one segment. */
    UncertainMotion motion(std::size_t from, std::size_t to) const
    {
        const auto& a = nodes_[from];
        const auto& b = nodes_[to];
        const Rigid robot_from_start = b.start_from_robot.inverse();
        const Matrix6 to_robot = adjoint(robot_from_start);
        const Matrix6 grown =
            from < to ? Matrix6(b.covariance - a.covariance) : Matrix6(a.covariance - b.covariance);
        return {a.start_from_robot.inverse() * b.start_from_robot,
                to_robot * grown * to_robot.transpose()};
    }

 private:
    struct Node
    {
        int segment = 0;
        Rigid start_from_robot;
        Matrix6 covariance = Matrix6::Zero();  ///< summed up, in the tangent at the start
    };

    static Node advanced(const Node& before, const UncertainMotion& step)
    {
        Node node = before;
        node.start_from_robot = before.start_from_robot * step.motion;
        const Matrix6 to_start = adjoint(node.start_from_robot);
        node.covariance += to_start * step.covariance * to_start.transpose();
        return node;
    }

    std::vector<Node> nodes_;
};

/** A loop, ready to be compared. */
struct Loop
{
    std::size_t candidate = 0;  ///< node
    std::size_t query = 0;
    UncertainMotion candidate_from_query;
    UncertainMotion query_from_candidate;
};

std::vector<Loop> loops_of(const PoseGraph& graph)
{
    std::vector<Loop> loops;
    loops.reserve(graph.loops.size());
    for (const auto& edge : graph.loops)
    {
        const auto motion = motion_of(edge);
        loops.push_back({graph.index_of(edge.a), graph.index_of(edge.b), motion, inverse(motion)});
    }
    return loops;
}

/** The cycle from query i over candidate i, candidate j and query j back to query i. */
double cycle_error(const OdometryChain& odometry, const Loop& i, const Loop& j)
{
    return squared_error(i.query_from_candidate * odometry.motion(i.candidate, j.candidate) *
                         j.candidate_from_query * odometry.motion(j.query, i.query));
}

bool are_connected(const OdometryChain& odometry, const Loop& i, const Loop& j)
{
    return odometry.segment(i.candidate) == odometry.segment(j.candidate) &&
           odometry.segment(i.query) == odometry.segment(j.query);
}

double error_against_odometry(const OdometryChain& odometry, const Loop& loop)
{
    return squared_error(loop.candidate_from_query * odometry.motion(loop.query, loop.candidate));
}

double limit_of(double probability, const std::string& name)
{
    if (!(probability > 0 && probability <= 1))
        throw std::invalid_argument("AgreementLimits: " + name + "=" + std::to_string(probability) +
                                    " outside (0, 1]");
    return probability < 1 ? mrpt::math::chi2inv(probability, 6)
                           : std::numeric_limits<double>::infinity();
}

/** The largest consistent set of some loops, added to the agreement. */
void add_largest_set(const OdometryChain& odometry,
                     const std::vector<Loop>& loops,
                     const std::vector<std::size_t>& members,
                     double limit,
                     const CheckCancelled& check_cancelled,
                     LoopAgreement& agreement)
{
    std::vector<std::vector<bool>> agrees(members.size(), std::vector<bool>(members.size()));
    for (std::size_t i = 0; i < members.size(); ++i)
    {
        check_cancelled();
        for (std::size_t j = 0; j < i; ++j)
            agrees[i][j] = agrees[j][i] =
                cycle_error(odometry, loops[members[i]], loops[members[j]]) <= limit;
    }
    const auto clique = largest_clique(agrees, check_cancelled);
    agreement.is_largest = agreement.is_largest && clique.upper_bound == clique.vertices.size();
    for (std::size_t i = 0; i < members.size(); ++i)
        (std::binary_search(clique.vertices.begin(), clique.vertices.end(), i)
             ? agreement.consistent
             : agreement.against_others)
            .push_back(members[i]);
}
}  // namespace

double cycle_error(const PoseGraph& graph, std::size_t loop_i, std::size_t loop_j)
{
    graph.check();
    const OdometryChain odometry(graph);
    const auto loops = loops_of(graph);
    const auto& i = loops.at(loop_i);
    const auto& j = loops.at(loop_j);
    if (!are_connected(odometry, i, j))
        throw std::invalid_argument("cycle_error: no odometry connects the loops' ends");
    return cycle_error(odometry, i, j);
}

std::vector<double> errors_of_neighbours(const PoseGraph& graph)
{
    const OdometryChain odometry(graph);
    auto loops = loops_of(graph);
    std::stable_sort(
        loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.query < b.query; });
    std::vector<double> errors;
    for (std::size_t i = 1; i < loops.size(); ++i)
        if (are_connected(odometry, loops[i - 1], loops[i]))
            errors.push_back(cycle_error(odometry, loops[i - 1], loops[i]));
    return errors;
}

std::vector<double> errors_against_odometry(const PoseGraph& graph)
{
    const OdometryChain odometry(graph);
    std::vector<double> errors;
    for (const auto& loop : loops_of(graph))
        if (odometry.segment(loop.candidate) == odometry.segment(loop.query))
            errors.push_back(error_against_odometry(odometry, loop));
    return errors;
}

LoopAgreement find_consistent_loops(const PoseGraph& graph,
                                    const AgreementLimits& limits,
                                    const CheckCancelled& check_cancelled)
{
    graph.check();
    const double pairwise = limit_of(limits.pairwise, "pairwise");
    const double with_odometry = limit_of(limits.with_odometry, "with_odometry");
    const OdometryChain odometry(graph);
    const auto loops = loops_of(graph);
    LoopAgreement agreement;
    std::map<std::pair<int, int>, std::vector<std::size_t>> groups;  // by the segments they join
    for (std::size_t i = 0; i < loops.size(); ++i)
    {
        const auto& loop = loops[i];
        const std::pair segments(odometry.segment(loop.candidate), odometry.segment(loop.query));
        if (segments.first == segments.second &&
            error_against_odometry(odometry, loop) > with_odometry)
            agreement.against_odometry.push_back(i);
        else
            groups[segments].push_back(i);
    }
    for (const auto& [segments, members] : groups)
        add_largest_set(odometry, loops, members, pairwise, check_cancelled, agreement);
    std::sort(agreement.consistent.begin(), agreement.consistent.end());
    std::sort(agreement.against_others.begin(), agreement.against_others.end());
    return agreement;
}

}  // namespace fild
