// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/map_builder.h"

#include "fild/graph/graph_builder.h"
#include "fild/graph/pairwise_consistency.h"
#include "fild/graph/robust_optimizer.h"
#include "fild/mapping/motion_scale.h"
#include "fild/mapping/pair_poses.h"
#include "fild/mapping/visual_odometry.h"
#include "motion_estimate.h"
#include "noise_scale.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace fild
{
namespace
{
Withheld withheld_for(NoMetricPose reason)
{
    switch (reason)
    {
        case NoMetricPose::none:
            return Withheld::none;
        case NoMetricPose::not_calibrated:
            return Withheld::not_calibrated;
        case NoMetricPose::no_depth:
            return Withheld::no_depth;
        case NoMetricPose::too_few_points:
            return Withheld::too_few_points;
        case NoMetricPose::no_model:
            return Withheld::no_model;
        case NoMetricPose::degenerate:
            return Withheld::degenerate;
        case NoMetricPose::disagreement:
            return Withheld::disagreement;
    }
    return Withheld::none;
}

/** The edge that a metric pose makes, or why it makes none. */
void set_pose(LoopEdge& edge, const RelativePose& pose, const Place& candidate, const Place& query)
{
    edge.withheld = withheld_for(pose.reason);
    const bool is_distorted = candidate.metric.depth_defect == DepthDefect::distorted ||
                              query.metric.depth_defect == DepthDefect::distorted;
    if (edge.withheld == Withheld::not_calibrated && is_distorted)
        edge.withheld = Withheld::distorted;
    edge.unscaled.reset();
    if (pose.candidate_from_query_unscaled)
        edge.unscaled =
            unscaled_motion(*pose.candidate_from_query_unscaled, candidate.metric, query.metric);
    if (!pose.candidate_from_query) return;
    edge.motion = robot_motion(*pose.candidate_from_query, candidate.metric, query.metric);
    if (!edge.motion) edge.withheld = Withheld::singular_covariance;
}

/** While the robot stands still its loops tell the same again and again: the first counts. */
void withhold_repetitions(std::vector<LoopEdge>& loops, const PlaceMap& places)
{
    std::set<std::pair<FrameId, FrameId>> seen;
    for (auto& loop : loops)
    {
        const auto stands_since = [&](FrameId frame)
        { return places.find(frame)->stands_since.value_or(frame); };
        if (loop.withheld != Withheld::none) continue;
        const bool is_new =
            seen.emplace(stands_since(loop.query), stands_since(loop.candidate)).second;
        if (!is_new) loop.withheld = Withheld::stood_still;
    }
}

/** Sum of the squared errors of a graph's edges at its nodes' poses. A loop's information is
 *  weighed already. */
double chi2_of(const PoseGraph& graph)
{
    std::map<FrameId, const mrpt::poses::CPose3D*> pose_of;
    for (const auto& node : graph.nodes) pose_of[node.frame] = &node.map_from_robot;
    double sum = 0;
    for (const auto* edges : {&graph.odometry, &graph.loops})
        for (const auto& edge : *edges)
            sum += squared_error(edge, *pose_of.at(edge.a), *pose_of.at(edge.b));
    for (const auto& prior : graph.priors) sum += squared_error(prior, *pose_of.at(prior.frame));
    return sum;
}

TrajectorySource source_of(const MotionEstimate& estimate)
{
    if (estimate.way.poses().empty()) return TrajectorySource::none;
    bool has_vision = false;
    bool has_others = false;
    for (const auto& source : estimate.sources)
        if (source.left_out.empty()) (source.kind == "vision" ? has_vision : has_others) = true;
    if (!has_vision) return TrajectorySource::recorded;
    return has_others ? TrajectorySource::combined : TrajectorySource::vision;
}

/** Makes the loops, and then the motion between keyframes, as uncertain as the recording shows that
 *  they are. \param edges  the loops of the graph. */
void scale_noise(PoseGraph& graph, Map& map, const std::vector<LoopEdge*>& edges)
{
    constexpr double kQuantile = 0.25;  // where 30 % of the loops are false half of the pairs are
    map.loop_noise_scale = noise_scale_of(errors_of_neighbours(graph), 6, kQuantile);
    const double loop_variance = map.loop_noise_scale * map.loop_noise_scale;
    for (auto& loop : graph.loops) loop.information *= 1 / loop_variance;
    for (auto* edge : edges) edge->motion->covariance *= loop_variance;
    map.motion_noise_scale = noise_scale_of(errors_against_odometry(graph), 6, kQuantile);
    for (auto& edge : graph.odometry)
        edge.information *= 1 / (map.motion_noise_scale * map.motion_noise_scale);
}

/** \param priors  of each used receiver, as the graph has them. */
void count_priors(const std::vector<std::vector<GraphPrior>>& priors,
                  const GraphSolution& solution,
                  std::vector<MotionSourceUse>& sources)
{
    auto result = solution.priors.begin();
    auto receiver = priors.begin();
    for (auto& source : sources)
    {
        if (source.kind != "gps" || !source.left_out.empty()) continue;
        source.factors = receiver->size();
        const auto end = result + static_cast<std::ptrdiff_t>(receiver->size());
        source.without_weight = static_cast<std::size_t>(
            std::count_if(result, end, [](const PriorResult& prior) { return prior.weight == 0; }));
        result = end;
        ++receiver;
    }
}
}  // namespace

const char* to_word(TrajectorySource source)
{
    switch (source)
    {
        case TrajectorySource::none:
            return "none";
        case TrajectorySource::recorded:
            return "recorded";
        case TrajectorySource::vision:
            return "vision";
        case TrajectorySource::combined:
            return "combined";
    }
    return "";
}

MapBuilder::MapBuilder(const TDetectorOptions& detector_options, const TGraphOptions& graph_options)
    : detector_options_(detector_options), graph_options_(graph_options), recorder_(graph_options)
{
}

void MapBuilder::add_frame(FrameId frame, double timestamp)
{
    recorder_.add_frame(frame, timestamp);
    end_ = FrameId{to_index(frame) + 1};
}

void MapBuilder::add(const DetectorOutcome& outcome)
{
    const auto& verdict = outcome.verdict;
    if (!verdict.accepted()) return;
    loops_.push_back({verdict.candidate->frame, verdict.frame, outcome.pose});
    if (loops_.back().pose) loops_.back().pose->inliers = {};  // no longer needed
}

Map MapBuilder::build(const PlaceMap& places,
                      StageTimes& times,
                      const CheckCancelled& check_cancelled) const
{
    check_cancelled();
    const auto wanted = graph_options_.sources();
    const auto odometry = wanted.odometry ? recorder_.odometry() : Trajectory({}, {});
    const auto gps = wanted.gps ? recorder_.gps() : GpsRecord();
    const auto vision =
        wanted.vision ? image_motion(places, times, check_cancelled) : Trajectory({}, {});
    const auto estimate = [&]
    {
        const StageTimer timer(times, "trajectory");
        return estimate_motion(odometry, vision, gps, graph_options_, check_cancelled);
    }();
    Map map{estimate.way};
    map.trajectory_source = source_of(estimate);
    map.sources = estimate.sources;
    map.unused_sources = odometry.report().other_sources;
    if (!odometry.report().source.empty()) map.recorded.push_back(odometry.report());
    for (const auto& track : gps.tracks) map.recorded.push_back(track.report);
    map.origin = estimate.origin;
    const auto& compared =
        odometry.poses().empty() && vision.poses().empty() ? map.trajectory : odometry;
    if (detector_options_.relative_pose.enabled && !compared.poses().empty())
    {
        map.compared_source = compared.report().source;
        map.agreement =
            compare_motions(places, compared, detector_options_, times, check_cancelled);
    }
    map.loops.reserve(loops_.size());
    for (const auto& loop : loops_) map.loops.push_back(edge_of(loop, places));
    if (detector_options_.relative_pose.enabled)
        scale_by_motion(map, places, times, check_cancelled);
    withhold_repetitions(map.loops, places);
    check_cancelled();
    const StageTimer timer(times, "graph");
    solve(map, estimate, check_cancelled);
    return map;
}

Trajectory MapBuilder::image_motion(const PlaceMap& places,
                                    StageTimes& times,
                                    const CheckCancelled& check_cancelled) const
{
    const auto motions = visual_odometry(
        places, end_, detector_options_, graph_options_.max_speed_m_per_s, times, check_cancelled);
    const auto trajectory = trajectory_from_motions(motions);
    auto report = trajectory.report();
    report.source = motions.empty() ? "" : "images";
    return Trajectory(trajectory, std::move(report));
}

LoopEdge MapBuilder::edge_of(const Loop& loop, const PlaceMap& places) const
{
    LoopEdge edge{loop.candidate, loop.query};
    if (loop.pose)
        set_pose(edge, *loop.pose, *places.find(loop.candidate), *places.find(loop.query));
    else
        edge.withheld = Withheld::not_enabled;
    return edge;
}

void MapBuilder::scale_by_motion(Map& map,
                                 const PlaceMap& places,
                                 StageTimes& times,
                                 const CheckCancelled& check_cancelled) const
{
    std::vector<std::size_t> without_depth;
    for (std::size_t i = 0; i < map.loops.size(); ++i)
        if (map.loops[i].withheld == Withheld::no_depth) without_depth.push_back(i);
    if (map.trajectory.poses().empty())
    {
        for (const auto i : without_depth) map.loops[i].withheld = Withheld::no_odometry;
        return;
    }
    const MotionScale scale(places, map.trajectory, detector_options_);
    std::set<FrameId> wanted;
    for (const auto i : without_depth) wanted.insert({map.loops[i].candidate, map.loops[i].query});
    const std::vector<FrameId> frames(wanted.begin(), wanted.end());
    std::vector<KeypointDepths> depths(frames.size());
    const int num_threads = detector_options_.runtime.num_threads;
    timed_parallel_for(num_threads,
                       frames.size(),
                       times,
                       check_cancelled,
                       [&](std::size_t i, StageTimes& own_times)
                       { depths[i] = scale.depths_of(frames[i], own_times); });
    std::map<FrameId, const KeypointDepths*> depths_of;
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        depths_of[frames[i]] = &depths[i];
        if (depths[i].known() > 0) map.frames_with_motion_depth.insert(frames[i]);
    }
    const PairPoses poses(detector_options_);
    timed_parallel_for(num_threads,
                       without_depth.size(),
                       times,
                       check_cancelled,
                       [&](std::size_t i, StageTimes& own_times)
                       {
                           auto& edge = map.loops[without_depth[i]];
                           const auto& candidate = *places.find(edge.candidate);
                           const auto& query = *places.find(edge.query);
                           const auto pose = poses.estimate(query,
                                                            *depths_of.at(edge.query),
                                                            candidate,
                                                            *depths_of.at(edge.candidate),
                                                            own_times);
                           set_pose(edge, pose, candidate, query);
                       });
}

void MapBuilder::solve(Map& map,
                       const MotionEstimate& estimate,
                       const CheckCancelled& check_cancelled) const
{
    std::vector<LoopMeasurement> measured;
    std::vector<LoopEdge*> edges;
    for (auto& loop : map.loops)
    {
        if (!loop.motion || loop.withheld != Withheld::none) continue;
        if (!map.trajectory.pose(loop.candidate) || !map.trajectory.pose(loop.query))
        {
            loop.withheld = Withheld::frame_without_pose;
            continue;
        }
        measured.push_back({loop.candidate, loop.query, *loop.motion});
        edges.push_back(&loop);
    }
    if (map.trajectory.poses().empty()) return;
    auto built = build_pose_graph(estimate.motion, measured, graph_options_);
    for (auto& node : built.graph.nodes)
        node.map_from_robot = map.trajectory.pose(node.frame)->map_from_robot;
    scale_noise(built.graph, map, edges);
    const auto priors = estimate.priors(frames_of(built.graph), graph_options_.max_gap_s);
    built.graph.priors = joined(priors);
    const auto solution = solve_graph(built.graph, graph_options_, check_cancelled);
    count_priors(priors, solution, map.sources);
    for (std::size_t i = 0; i < edges.size(); ++i) edges[i]->result = solution.loops[i];
    map.graph = solved_graph(built.graph, solution);
    map.parts = solution.parts;
    map.is_largest_set = solution.is_largest_set;
    map.optimizations = solution.optimizations;
    map.optimized = corrected_poses(map.trajectory, map.graph);
    map.chi2_after = chi2_of(map.graph);
    auto unsolved = map.graph;
    for (std::size_t i = 0; i < unsolved.nodes.size(); ++i)
        unsolved.nodes[i].map_from_robot = built.graph.nodes[i].map_from_robot;
    map.chi2_before = chi2_of(unsolved);
}

}  // namespace fild
