// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.h"

#include "fild/core/words.h"
#include "fild/graph/graph_files.h"
#include "fild/graph/trajectory_files.h"
#include "fild/rawlog/pose_conversion.h"
#include "fild/results/poses_csv.h"
#include "map_notes.h"
#include "track_kml.h"

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DQuat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace fild
{
namespace
{
LoopRow::Three angles_of(const mrpt::poses::CPose3D& pose)
{
    return {pose.yaw(), pose.pitch(), pose.roll()};
}

PoseNumbers numbers_of(const mrpt::poses::CPose3D& pose)
{
    const mrpt::poses::CPose3DQuat quaternion(pose);
    const auto& q = quaternion.quat();
    return {pose.x(), pose.y(), pose.z(), q.x(), q.y(), q.z(), q.r()};
}

void write_poses(const Map& map, const std::string& path)
{
    CsvWriter<PoseRow> csv(path, poses_csv_columns());
    const auto& input = map.trajectory.poses();
    for (std::size_t i = 0; i < input.size(); ++i)
        csv.add({input[i].frame,
                 numbers_of(input[i].map_from_robot),
                 numbers_of(map.optimized[i].map_from_robot)});
    csv.commit();
}

/** A frame whose verdict was lost to an error may have a pose: then there are more poses. */
std::size_t frames_without_pose(const Map& map, std::size_t camera_frames)
{
    return camera_frames - std::min(camera_frames, map.trajectory.poses().size());
}

/** What files of pose graphs can hold: no priors. */
PoseGraph edges_of(const PoseGraph& graph)
{
    return {graph.nodes, graph.odometry, graph.loops, {}};
}

void write_trajectories(const Map& map,
                        std::size_t camera_frames,
                        TrajectoryFormat format,
                        const OutputFolder& folder,
                        std::vector<std::string>& notes)
{
    const bool is_kitti = format == TrajectoryFormat::kitti;
    const auto missing = frames_without_pose(map, camera_frames);
    if (is_kitti && missing > 0)
    {
        notes.push_back("no trajectory files: " + count_of(missing, "frame") +
                        " without a pose, which KITTI's format cannot express; set [graph] "
                        "trajectory_format = tum");
        return;
    }
    const std::string ending = is_kitti ? ".kitti" : ".tum";
    write_trajectory(folder.file("trajectory_input" + ending), map.trajectory.poses(), format);
    write_trajectory(folder.file("trajectory_optimized" + ending), map.optimized, format);
}
void add_sources(MapSummary& summary, const Map& map)
{
    summary.other_sources = map.unused_sources;
    std::vector<std::string> used;
    for (const auto& source : map.sources)
    {
        summary.sources.push_back({source.kind,
                                   source.name,
                                   source.factors,
                                   source.without_weight,
                                   source.contradictions,
                                   source.noise_scale,
                                   source.left_out});
        auto& names = source.left_out.empty() ? used : summary.other_sources;
        names.push_back(source.name);
    }
    summary.trajectory_source = joined(used, ", ");
    std::sort(summary.other_sources.begin(), summary.other_sources.end());
}

void add_readings(MapSummary& summary, const std::vector<TrajectoryReport>& recorded)
{
    for (const auto& report : recorded)
    {
        summary.implausible_readings += report.implausible_readings;
        summary.late_readings += report.late_readings;
        summary.gaps += report.gaps;
        summary.clock_jumps += report.clock_jumps;
        summary.unusable_readings += report.unusable_readings;
    }
}
}  // namespace

void remove_map_files(const OutputFolder& folder)
{
    for (const auto* name : {"poses.csv",
                             "poses.graph",
                             "poses.g2o",
                             "trajectory_input.tum",
                             "trajectory_optimized.tum",
                             "trajectory_input.kitti",
                             "trajectory_optimized.kitti",
                             "track.kml",
                             "map.simplemap",
                             "map.3Dscene",
                             "map_top.png",
                             "map_perspective.png"})
        std::filesystem::remove(folder.file(name));
}

std::vector<std::string> write_map_files(const Map& map,
                                         std::size_t camera_frames,
                                         const TGraphOptions& options,
                                         const OutputFolder& folder)
{
    std::vector<std::string> notes;
    if (map.graph.nodes.empty())
    {
        notes.emplace_back(
            "no map: it takes odometry, GPS or robot poses, or images with depth (stereo, RGB-D)");
        return notes;
    }
    write_poses(map, folder.file("poses.csv"));
    write_trajectories(map, camera_frames, options.trajectory_format, folder, notes);
    if (map.origin) write_track_kml(map, folder.file("track.kml"));
    const auto edges = edges_of(map.graph);
    const auto parts = connected_parts(edges);
    const auto connected = part_of(edges, parts.front());
    if (parts.size() > 1)
        notes.push_back("the pose graph is in " + std::to_string(parts.size()) +
                        " parts without an edge between them" +
                        (map.parts.size() > 1 ? ", so their relative poses are unknown"
                                              : ", which GPS alone puts in place") +
                        "; poses.graph and poses.g2o have the largest, " +
                        std::to_string(connected.nodes.size()) + " of " +
                        std::to_string(map.graph.nodes.size()) +
                        " keyframes, the other files have all");
    if (connected.nodes.size() > 1)
    {
        write_mrpt_graph(folder.file("poses.graph"), connected, options.graph_dimensions);
        write_g2o(folder.file("poses.g2o"), connected);
    }
    else
        notes.emplace_back("no poses.graph and no poses.g2o: a single keyframe has no edge");
    return notes;
}

MapSummary summary_of(const Map& map, std::size_t camera_frames, const TGraphOptions& options)
{
    MapSummary summary;
    summary.frames_without_pose = frames_without_pose(map, camera_frames);
    summary.trajectory = to_word(map.trajectory_source);
    summary.resets = map.trajectory.report().resets;
    add_sources(summary, map);
    add_readings(summary, map.recorded);
    summary.loop_noise_scale = map.loop_noise_scale;
    summary.motion_noise_scale = map.motion_noise_scale;
    if (const auto& origin = map.origin)
        summary.origin = {origin->latitude_deg, origin->longitude_deg, origin->height_m};
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
    summary.notes = notes_on_map(map, summary, options);
    return summary;
}

LoopRow row_of(const LoopEdge& loop)
{
    LoopRow row;
    const bool is_edge = loop.withheld == Withheld::none;
    row.edge = is_edge ? to_word(loop.result.fate) : to_word(loop.withheld);
    if (is_edge) row.weight = loop.result.weight;
    if (loop.motion)
    {
        const auto& pose = loop.motion->a_from_b;
        const auto deviation = [&](int i) { return std::sqrt(loop.motion->covariance(i, i)); };
        row.position = {pose.x(), pose.y(), pose.z()};
        row.angles = angles_of(pose);
        row.position_deviations = {deviation(0), deviation(1), deviation(2)};
        row.angle_deviations = {deviation(3), deviation(4), deviation(5)};
    }
    else if (loop.unscaled)
        row.angles = angles_of(mrpt_pose_from({loop.unscaled->rotation, {}}));
    if (loop.unscaled)
    {
        const auto& d = loop.unscaled->direction;
        row.direction = {d[0], d[1], d[2]};
    }
    return row;
}

}  // namespace fild
