// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/pose_graph.h"

#include "information.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
std::string to_text(FrameId frame)
{
    return std::to_string(to_index(frame));
}

void check_edge(const PoseGraph& graph, const GraphEdge& edge, const std::string& kind)
{
    const auto name = kind + " edge " + to_text(edge.a) + " -> " + to_text(edge.b);
    if (edge.a == edge.b) throw std::invalid_argument(name + ": from a node to itself");
    for (const auto end : {edge.a, edge.b}) graph.index_of(end);
    const auto what = "information of the " + name;
    require_information(edge.a_from_b, edge.information, what);
    information_in_tangent(edge.a_from_b, edge.information, what);
}

void check_prior(const PoseGraph& graph, const GraphPrior& prior)
{
    const auto name = "prior of node " + to_text(prior.frame);
    graph.index_of(prior.frame);
    double sum = 0;
    for (const auto& point : {prior.map_from_point, prior.robot_from_point})
        sum += point.x + point.y + point.z;
    const Eigen::Matrix3d information = prior.information.asEigen();
    if (!std::isfinite(sum) || !information.allFinite())
        throw std::invalid_argument(name + ": numbers that are not finite");
    if (!information.isApprox(information.transpose()) ||
        Eigen::LLT<Eigen::Matrix3d>(information).info() != Eigen::Success)
        throw std::invalid_argument(name + ": information is not positive definite");
}

/** The root of a node's part, in a forest of parents (union-find). */
std::size_t root_of(std::vector<std::size_t>& parents, std::size_t node)
{
    while (parents[node] != node) node = parents[node] = parents[parents[node]];
    return node;
}
}  // namespace

std::size_t PoseGraph::index_of(FrameId frame) const
{
    const auto found =
        std::lower_bound(nodes.begin(),
                         nodes.end(),
                         frame,
                         [](const GraphNode& node, FrameId wanted) { return node.frame < wanted; });
    if (found == nodes.end() || found->frame != frame)
        throw std::invalid_argument("the pose graph has no node for frame " + to_text(frame));
    return static_cast<std::size_t>(found - nodes.begin());
}

void PoseGraph::check() const
{
    const auto identity = mrpt::math::CMatrixDouble66::Identity();
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        const auto name = "node " + to_text(nodes[i].frame);
        if (i > 0 && nodes[i].frame <= nodes[i - 1].frame)
            throw std::invalid_argument(name + " comes after node " + to_text(nodes[i - 1].frame));
        require_information(nodes[i].map_from_robot, identity, name);
    }
    for (const auto& edge : odometry)
    {
        check_edge(*this, edge, "odometry");
        if (index_of(edge.b) != index_of(edge.a) + 1)
            throw std::invalid_argument("odometry edge " + to_text(edge.a) + " -> " +
                                        to_text(edge.b) + ": not from a node to the next one");
    }
    for (const auto& edge : loops) check_edge(*this, edge, "loop");
    for (const auto& prior : priors) check_prior(*this, prior);
}

std::vector<std::vector<FrameId>> connected_parts(const PoseGraph& graph)
{
    std::vector<std::size_t> parents(graph.nodes.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    const auto join = [&](FrameId one, FrameId other)
    {
        const auto a = root_of(parents, graph.index_of(one));
        const auto b = root_of(parents, graph.index_of(other));
        parents[std::max(a, b)] = std::min(a, b);
    };
    for (const auto* edges : {&graph.odometry, &graph.loops})
        for (const auto& edge : *edges) join(edge.a, edge.b);
    for (const auto& prior : graph.priors) join(graph.priors.front().frame, prior.frame);
    std::vector<std::vector<FrameId>> by_root(graph.nodes.size());
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
        by_root[root_of(parents, i)].push_back(graph.nodes[i].frame);
    const auto empty = std::remove_if(
        by_root.begin(), by_root.end(), [](const auto& part) { return part.empty(); });
    by_root.erase(empty, by_root.end());
    std::stable_sort(by_root.begin(),
                     by_root.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return by_root;
}

PoseGraph part_of(const PoseGraph& graph, const std::vector<FrameId>& frames)
{
    const std::set<FrameId> wanted(frames.begin(), frames.end());
    for (const auto frame : wanted) graph.index_of(frame);
    PoseGraph part;
    for (const auto& node : graph.nodes)
        if (wanted.count(node.frame) > 0) part.nodes.push_back(node);
    const auto is_inside = [&](const GraphEdge& edge)
    { return wanted.count(edge.a) > 0 && wanted.count(edge.b) > 0; };
    std::copy_if(
        graph.odometry.begin(), graph.odometry.end(), std::back_inserter(part.odometry), is_inside);
    std::copy_if(graph.loops.begin(), graph.loops.end(), std::back_inserter(part.loops), is_inside);
    std::copy_if(graph.priors.begin(),
                 graph.priors.end(),
                 std::back_inserter(part.priors),
                 [&](const GraphPrior& prior) { return wanted.count(prior.frame) > 0; });
    return part;
}

}  // namespace fild
