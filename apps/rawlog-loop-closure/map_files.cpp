// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.h"

#include "fild/graph/graph_files.h"
#include "fild/graph/trajectory_files.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/rawlog_reader.h"

#include <mrpt/obs/CObservation.h>

#include <cmath>
#include <filesystem>
#include <set>

namespace fild
{
namespace
{
/** The camera observations of a graph's nodes. */
KeyframeObservations read_keyframes(const PoseGraph& graph, const MappedRawlog& rawlog)
{
    std::set<FrameId> wanted;
    for (const auto& node : graph.nodes) wanted.insert(node.frame);
    KeyframeObservations keyframes;
    RawlogReader reader(rawlog.path);
    FrameBuilder builder(rawlog.input, rawlog.path);
    while (keyframes.size() < wanted.size())
    {
        const auto observation = reader.next();
        if (!observation) break;
        if (!builder.accepts(*observation)) continue;
        if (wanted.count(builder.next_id()) != 0)
            keyframes[builder.next_id()].push_back(observation);
        builder.skip(*observation);
    }
    return keyframes;
}

std::string count_of(std::size_t count, const std::string& thing)
{
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/** What the user should know of the loops that are no edges. */
void add_notes_on_loops(MapSummary& summary)
{
    const auto withheld = [&](Withheld reason)
    {
        const auto found = summary.loops_withheld.find(to_word(reason));
        return found == summary.loops_withheld.end() ? 0 : found->second;
    };
    const auto add = [&](std::size_t count, const std::string& why)
    {
        if (count > 0)
            summary.notes.push_back(count_of(count, "loop closure") + " without an edge: " + why);
    };
    add(withheld(Withheld::not_calibrated),
        "the camera is not calibrated; [input] camera_parameters gives a calibration");
    add(withheld(Withheld::distorted), "lens distortion was left in; set [input] undistort = true");
    add(withheld(Withheld::no_odometry),
        "a single camera sees directions but no distances, and there is no odometry");
}

void write_trajectories(const Map& map,
                        const MappedRawlog& rawlog,
                        TrajectoryFormat format,
                        const OutputFolder& folder,
                        std::vector<std::string>& notes)
{
    const bool is_kitti = format == TrajectoryFormat::kitti;
    const auto missing = rawlog.camera_frames - map.optimized.size();
    if (is_kitti && missing > 0)
    {
        notes.push_back("no trajectory files: " + count_of(missing, "frame") +
                        " without a pose, which KITTI's format cannot tell; set [graph] "
                        "trajectory_format = tum");
        return;
    }
    const std::string ending = is_kitti ? ".kitti" : ".tum";
    write_trajectory(folder.file("trajectory_input" + ending), map.trajectory.poses(), format);
    write_trajectory(folder.file("trajectory_optimized" + ending), map.optimized, format);
}
}  // namespace

void remove_map_files(const OutputFolder& folder)
{
    for (const auto* name : {"poses.graph",
                             "poses.g2o",
                             "trajectory_input.tum",
                             "trajectory_optimized.tum",
                             "trajectory_input.kitti",
                             "trajectory_optimized.kitti",
                             "map.simplemap"})
        std::filesystem::remove(folder.file(name));
}

std::vector<std::string> write_map_files(const Map& map,
                                         const MappedRawlog& rawlog,
                                         const TGraphOptions& options,
                                         const OutputFolder& folder)
{
    std::vector<std::string> notes;
    if (map.graph.nodes.empty())
    {
        notes.emplace_back(map.trajectory_source == TrajectorySource::none
                               ? "no map: the recording has no odometry, and its images no depth"
                               : "no map: the odometry gives no frame a pose");
        return notes;
    }
    write_trajectories(map, rawlog, options.trajectory_format, folder, notes);
    const auto connected = part_of(map.graph, map.parts.front());
    if (map.parts.size() > 1)
        notes.push_back(
            "the pose graph is in " + std::to_string(map.parts.size()) +
            " parts that nothing connects; poses.graph and poses.g2o have the largest, " +
            std::to_string(connected.nodes.size()) + " of " +
            std::to_string(map.graph.nodes.size()) + " keyframes");
    if (connected.nodes.size() > 1)
    {
        write_mrpt_graph(folder.file("poses.graph"), connected, options.graph_dimensions);
        write_g2o(folder.file("poses.g2o"), connected);
    }
    else
        notes.emplace_back("no poses.graph and no poses.g2o: a single keyframe has no edge");
    if (options.simple_map)
        write_simple_map(
            folder.file("map.simplemap"), map.graph, read_keyframes(map.graph, rawlog));
    return notes;
}

MapSummary summary_of(const Map& map)
{
    MapSummary summary;
    const auto& report = map.trajectory.report();
    summary.trajectory = to_word(map.trajectory_source);
    if (map.trajectory_source == TrajectorySource::recorded)
        summary.trajectory_source = report.source;
    summary.other_sources = report.other_sources;
    summary.frames_without_pose = report.frames_without_pose.size();
    summary.resets = report.resets;
    summary.gaps = report.gaps;
    summary.clock_jumps = report.clock_jumps;
    summary.unusable_readings = report.unusable_readings;
    summary.nodes = map.graph.nodes.size();
    summary.odometry_edges = map.graph.odometry.size();
    summary.loop_edges = map.graph.loops.size();
    for (const auto& loop : map.loops)
    {
        if (loop.withheld != Withheld::none)
            ++summary.loops_withheld[to_word(loop.withheld)];
        else if (loop.result.fate != LoopFate::used)
            ++summary.loops_without_weight[to_word(loop.result.fate)];
    }
    summary.chi2_before = map.chi2_before;
    summary.chi2_after = map.chi2_after;
    for (const auto& part : map.parts) summary.parts.push_back(part.size());
    summary.is_largest_set = map.is_largest_set;
    summary.optimizations = map.optimizations;
    add_notes_on_loops(summary);
    return summary;
}

LoopRow row_of(const LoopEdge& loop)
{
    LoopRow row;
    const bool is_edge = loop.withheld == Withheld::none;
    row.edge = is_edge ? to_word(loop.result.fate) : to_word(loop.withheld);
    if (is_edge) row.weight = loop.result.weight;
    if (!loop.motion) return row;
    const auto& pose = loop.motion->a_from_b;
    row.candidate_from_query = {
        pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll()};
    for (int i = 0; i < 6; ++i)
        row.deviations[static_cast<std::size_t>(i)] = std::sqrt(loop.motion->covariance(i, i));
    return row;
}

}  // namespace fild
