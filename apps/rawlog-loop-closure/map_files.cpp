// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.h"

#include "fild/graph/graph_files.h"
#include "fild/graph/trajectory_files.h"
#include "fild/rawlog/frame_builder.h"
#include "fild/rawlog/pose_conversion.h"
#include "fild/rawlog/rawlog_reader.h"
#include "fild/report/pose_csv.h"

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DQuat.h>

#include <cmath>
#include <filesystem>
#include <map>
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
    RawlogReader reader(rawlog.path, rawlog.input.max_entry_megabytes);
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

std::string joined(const std::vector<std::string>& names)
{
    std::string all;
    for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
    return all;
}

/** Why no reading of the robot's motion was used, where there are some. */
void add_note_on_sources(const Map& map, MapSummary& summary)
{
    if (map.unused_sources.empty()) return;
    const auto unused = joined(map.unused_sources);
    if (map.trajectory_source == TrajectorySource::recorded)
        summary.notes.push_back("the robot's motion is that of " + summary.trajectory_source +
                                "; not used: " + unused +
                                "; [graph] motion_source and motion_sensor_label choose");
    else
        summary.notes.push_back(unused +
                                " of the recording gives no frame a pose, or is not what [graph] "
                                "motion_source and motion_sensor_label ask for");
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
    add(withheld(Withheld::frame_without_pose), "nothing tells where the robot was at its frames");
}

/** What has its own note is left out. */
void add_note_on_most_loops(const Map& map, MapSummary& summary)
{
    std::map<std::string, std::size_t> lost = summary.loops_without_weight;
    for (const auto& [reason, count] : summary.loops_withheld) lost[reason] += count;
    for (const auto told : {Withheld::not_calibrated,
                            Withheld::distorted,
                            Withheld::no_odometry,
                            Withheld::frame_without_pose,
                            Withheld::not_enabled})
        lost.erase(to_word(told));
    std::size_t sum = 0;
    std::string reasons;
    for (const auto& [reason, count] : lost)
    {
        sum += count;
        reasons += (reasons.empty() ? "" : ", ") + reason + " " + std::to_string(count);
    }
    if (2 * sum > map.loops.size())
        summary.notes.push_back(std::to_string(sum) + " of " +
                                count_of(map.loops.size(), "loop closure") +
                                " have no part in the map: " + reasons);
}

void add_note_on_frames(const Map& map, MapSummary& summary)
{
    if (map.trajectory.poses().empty() || summary.frames_without_pose == 0) return;
    summary.notes.push_back(count_of(summary.frames_without_pose, "frame") +
                            " without a pose, for which no motion is known");
}

LoopRow::Unscaled unscaled_row(const UnscaledMotion& motion)
{
    const auto turned = mrpt_pose_from({motion.rotation, {}});
    const auto& d = motion.direction;
    return {{turned.yaw(), turned.pitch(), turned.roll()}, {d[0], d[1], d[2]}};
}

PoseCsv::PoseNumbers numbers_of(const mrpt::poses::CPose3D& pose)
{
    const mrpt::poses::CPose3DQuat quaternion(pose);
    const auto& q = quaternion.quat();
    return {pose.x(), pose.y(), pose.z(), q.x(), q.y(), q.z(), q.r()};
}

void write_poses(const Map& map, const std::string& path)
{
    PoseCsv csv(path);
    const auto& input = map.trajectory.poses();
    for (std::size_t i = 0; i < input.size(); ++i)
        csv.add(input[i].frame,
                numbers_of(input[i].map_from_robot),
                numbers_of(map.optimized[i].map_from_robot));
    csv.commit();
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
    for (const auto* name : {"poses.csv",
                             "poses.graph",
                             "poses.g2o",
                             "trajectory_input.tum",
                             "trajectory_optimized.tum",
                             "trajectory_input.kitti",
                             "trajectory_optimized.kitti",
                             "map.simplemap",
                             "map.3Dscene",
                             "map_top.png",
                             "map_perspective.png"})
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
        notes.emplace_back(
            "no map: no odometry tells how the robot moved, and no depth of its images does");
        return notes;
    }
    write_poses(map, folder.file("poses.csv"));
    write_trajectories(map, rawlog, options.trajectory_format, folder, notes);
    const auto connected = part_of(map.graph, map.parts.front());
    if (map.parts.size() > 1)
        notes.push_back("the pose graph is in " + std::to_string(map.parts.size()) +
                        " parts that nothing connects, and where they lie to each other is "
                        "unknown; poses.graph "
                        "and poses.g2o have the largest, " +
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
    if (options.simple_map)
        write_simple_map(
            folder.file("map.simplemap"), map.graph, read_keyframes(map.graph, rawlog));
    return notes;
}

MapSummary summary_of(const Map& map, std::size_t camera_frames)
{
    MapSummary summary;
    summary.frames_without_pose = camera_frames - map.trajectory.poses().size();
    const auto& report = map.trajectory.report();
    summary.trajectory = to_word(map.trajectory_source);
    if (map.trajectory_source == TrajectorySource::recorded)
        summary.trajectory_source = report.source;
    summary.other_sources = map.unused_sources;
    summary.late_readings = report.late_readings;
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
    add_note_on_sources(map, summary);
    add_note_on_frames(map, summary);
    add_notes_on_loops(summary);
    add_note_on_most_loops(map, summary);
    return summary;
}

LoopRow row_of(const LoopEdge& loop)
{
    LoopRow row;
    const bool is_edge = loop.withheld == Withheld::none;
    row.edge = is_edge ? to_word(loop.result.fate) : to_word(loop.withheld);
    if (is_edge) row.weight = loop.result.weight;
    if (loop.unscaled) row.unscaled = unscaled_row(*loop.unscaled);
    if (!loop.motion) return row;
    const auto& pose = loop.motion->a_from_b;
    row.candidate_from_query = {
        pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll()};
    for (int i = 0; i < 6; ++i)
        row.deviations[static_cast<std::size_t>(i)] = std::sqrt(loop.motion->covariance(i, i));
    return row;
}

}  // namespace fild
