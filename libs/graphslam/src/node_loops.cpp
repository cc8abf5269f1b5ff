// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/node_loops.h"

#include "constraint.h"
#include "fild/graph/pairwise_consistency.h"
#include "fild/mapping/loop_edge.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
const TLoopClosureStreamOptions& with_poses(const TLoopClosureStreamOptions& options)
{
    if (!options.detector.relative_pose.enabled)
        throw std::invalid_argument(
            "[relative_pose] enabled=false: a loop without a metric pose is no edge");
    return options;
}

mrpt::poses::CPose3DPDFGaussian pdf_of(const RelativeMotion& motion)
{
    return {motion.a_from_b, motion.covariance};
}

GraphEdge edge_of(const RelativeMotion& motion)
{
    return {FrameId{0}, FrameId{1}, motion.a_from_b, information_of(motion.covariance)};
}
}  // namespace

NodeLoops::NodeLoops(const TLoopClosureStreamOptions& stream_options,
                     const TGraphOptions& graph_options,
                     const std::string& rawlog_path)
    : graph_options_(graph_options),
      stream_(with_poses(stream_options), rawlog_path),
      trajectory_(graph_options)
{
}

void NodeLoops::feed(const mrpt::obs::CActionCollection& actions)
{
    trajectory_.feed(actions);
}

void NodeLoops::feed(const mrpt::obs::CObservation& observation)
{
    trajectory_.feed(observation);
    for (auto fed = stream_.feed(observation); fed; fed = stream_.next()) add(*fed);
}

void NodeLoops::add(const FedFrame& fed)
{
    ++report_.camera_frames;
    const auto moment = add_moment(fed.timestamp);
    frames_[fed.frame] = {moment, nodes_.size()};
    for (const auto& outcome : fed.decided) add_outcome(outcome);
}

NodeLoops::Moment NodeLoops::add_moment(double timestamp)
{
    const Moment moment{FrameId{nodes_.size() + frames_.size()}, timestamp};
    trajectory_.add_frame(moment.id, timestamp);
    return moment;
}

void NodeLoops::add_node(NodeId node, double timestamp)
{
    nodes_.push_back({node, add_moment(timestamp)});
}

void NodeLoops::add_outcome(const DetectorOutcome& outcome)
{
    const auto& verdict = outcome.verdict;
    if (!verdict.accepted()) return;
    ++report_.loop_closures;
    const auto candidate = verdict.candidate->frame;
    if (!outcome.pose->candidate_from_query)
    {
        ++report_.withheld[to_word(outcome.pose->reason)];
        return;
    }
    const auto& places = stream_.places();
    const auto motion = robot_motion(*outcome.pose->candidate_from_query,
                                     places.find(candidate)->metric,
                                     places.find(verdict.frame)->metric);
    if (motion)
        waiting_.push_back({candidate, verdict.frame, *motion});
    else
        ++report_.withheld[to_word(Withheld::singular_covariance)];
}

std::vector<NodeLoop> NodeLoops::take_settled()
{
    std::vector<MeasuredLoop> settled;
    std::vector<MeasuredLoop> unsettled;
    for (auto& loop : waiting_)
        (frames_.at(loop.query).nodes_before < nodes_.size() ? settled : unsettled)
            .push_back(std::move(loop));
    waiting_ = std::move(unsettled);
    return settle(settled);
}

std::vector<NodeLoop> NodeLoops::take_all()
{
    while (const auto fed = stream_.drain()) add(*fed);
    for (const auto& outcome : stream_.finish()) add_outcome(outcome);
    const auto all = std::exchange(waiting_, {});
    if (!nodes_.empty()) return settle(all);
    if (!all.empty()) report_.withheld["same_node"] += all.size();
    return {};
}

std::vector<NodeLoop> NodeLoops::settle(const std::vector<MeasuredLoop>& loops)
{
    if (loops.empty()) return {};
    const auto trajectory = trajectory_.build();
    std::vector<NodeLoop> edges;
    for (const auto& loop : loops)
        if (auto edge = settle(loop, trajectory)) edges.push_back(std::move(*edge));
    return edges;
}

/** Of the node before a frame and the one after it that which is nearer in time; the order of
 *  arrival, not the time, tells which these are, for clocks jump. */
const NodeLoops::Node& NodeLoops::nearest_node(FrameId frame) const
{
    const auto& seen = frames_.at(frame);
    if (seen.nodes_before == 0) return nodes_.front();
    const auto& before = nodes_[seen.nodes_before - 1];
    if (seen.nodes_before == nodes_.size()) return before;
    const auto& after = nodes_[seen.nodes_before];
    const auto distance = [&](const Node& node)
    { return std::abs(node.moment.timestamp - seen.moment.timestamp); };
    return distance(after) < distance(before) ? after : before;
}

std::optional<NodeLoop> NodeLoops::settle(const MeasuredLoop& loop, const Trajectory& trajectory)
{
    const auto& from = nearest_node(loop.candidate);
    const auto& to = nearest_node(loop.query);
    const auto withhold = [&](const std::string& reason)
    {
        ++report_.withheld[reason];
        return std::nullopt;
    };
    if (from.moment.id >= to.moment.id) return withhold("same_node");

    auto pdf = pdf_of(loop.motion);
    const auto& candidate = frames_.at(loop.candidate).moment;
    const auto& query = frames_.at(loop.query).moment;
    if (from.moment.timestamp != candidate.timestamp)
    {
        const auto way = trajectory.motion(from.moment.id, candidate.id);
        if (!way) return withhold(to_word(Withheld::frame_without_pose));
        pdf = pdf_of(*way) + pdf;
    }
    if (to.moment.timestamp != query.timestamp)
    {
        const auto way = trajectory.motion(query.id, to.moment.id);
        if (!way) return withhold(to_word(Withheld::frame_without_pose));
        pdf += pdf_of(*way);
    }
    const RelativeMotion motion{pdf.mean, symmetric(pdf.cov)};
    const auto odometry = trajectory.motion(from.moment.id, to.moment.id);
    if (odometry && is_against_odometry(motion, *odometry))
        return withhold(to_word(LoopFate::against_odometry));
    return NodeLoop{loop.candidate, loop.query, from.id, to.id, motion};
}

bool NodeLoops::is_against_odometry(const RelativeMotion& loop,
                                    const RelativeMotion& odometry) const
{
    PoseGraph cycle;
    cycle.nodes = {{FrameId{0}, 0, {}}, {FrameId{1}, 0, odometry.a_from_b}};
    cycle.odometry = {edge_of(odometry)};
    cycle.loops = {edge_of(loop)};
    const AgreementLimits limits{graph_options_.pairwise_confidence,
                                 graph_options_.odometry_confidence};
    return !find_consistent_loops(cycle, limits).against_odometry.empty();
}

}  // namespace fild
