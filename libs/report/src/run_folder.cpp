// SPDX-License-Identifier: BSD-3-Clause
#include "run_folder.h"

#include "csv_table.h"
#include "fild/core/spread.h"
#include "fild/evaluation/frames_csv.h"
#include "fild/evaluation/metric.h"
#include "loop_edges.h"
#include "report_pictures.h"
#include "rounded.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json read_summary(const std::string& path)
{
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("cannot read " + path +
                                 "; is it the output folder of rawlog-loop-closure, and has the "
                                 "run ended?");
    auto summary = Json::parse(file, nullptr, false);
    for (const auto* key : {"rawlog", "options", "versions", "model", "memory"})
        if (summary.is_discarded() || !summary.contains(key))
            throw std::runtime_error(path + " is not the summary of a run");
    return summary;
}

/** Columns, not rows: shorter. */
Json frames_json(const std::vector<FrameVerdict>& frames)
{
    Json json;
    for (const auto* column : {"timestamp",
                               "sensors",
                               "sensor",
                               "keypoints",
                               "candidate",
                               "similarity",
                               "matches",
                               "inliers",
                               "support",
                               "rejection"})
        json[column] = Json::array();
    std::map<std::string, std::size_t> sensors;
    for (const auto& frame : frames)
    {
        const auto [sensor, is_new] = sensors.emplace(frame.sensor_label, sensors.size());
        if (is_new) json["sensors"].push_back(frame.sensor_label);
        json["sensor"].push_back(sensor->second);
        json["timestamp"].push_back(rounded(frame.timestamp, 3));
        json["keypoints"].push_back(frame.keypoints);
        const auto& candidate = frame.candidate;
        json["candidate"].push_back(candidate ? Json(to_index(candidate->frame)) : Json());
        json["similarity"].push_back(candidate ? Json(rounded(candidate->similarity, 4)) : Json());
        json["matches"].push_back(frame.matches);
        json["inliers"].push_back(frame.inliers);
        json["support"].push_back(rounded(frame.support, 3));
        json["rejection"].push_back(to_word(frame.rejection));
    }
    return json;
}

/** x, y, z, metres, for each frame; null where a frame has no pose. Empty without any pose. */
Json positions_json(const PosesOfFrames& poses)
{
    Json json = Json::array();
    for (const auto& pose : poses)
    {
        Json point;
        for (int axis = 0; pose && axis < 3; ++axis)
            point.push_back(rounded(pose->position[axis], 3));
        json.push_back(point);
    }
    return json;
}

/** `input`, `optimized` and `truth`, those that there are; the truth is laid over the last one. */
std::map<std::string, PosesOfFrames> read_trajectories(const RunFolder& run,
                                                       const std::optional<ReportTruth>& truth)
{
    std::map<std::string, PosesOfFrames> trajectories;
    auto true_poses = truth ? truth->poses : std::vector<PosedFrame>();
    for (const std::string name : {"input", "optimized"})
    {
        auto poses = read_run_poses(run.path, name, run.frames);
        if (!poses) continue;
        if (!true_poses.empty())
            true_poses = laid_over(timed_poses(*poses, run.frames), std::move(true_poses));
        trajectories[name] = std::move(*poses);
    }
    for (const auto& frame : true_poses) trajectories["truth"].push_back(frame.pose);
    return trajectories;
}

/** Columns of costs.csv, at most kMostRows rows of it. */
Json costs_json(const std::string& path)
{
    constexpr std::size_t kMostRows = 2000;
    const CsvTable table(path);
    Json json = {{"frame", Json::array()}, {"ms", Json::object()}};
    const std::string unit = "_ms";
    for (const auto row : spread_indices(kMostRows, table.rows()))
        for (const auto& column : table.columns())
        {
            const auto value = table.number(row, column);
            const bool is_time =
                column.size() > unit.size() &&
                column.compare(column.size() - unit.size(), unit.size(), unit) == 0;
            auto& list =
                is_time ? json["ms"][column.substr(0, column.size() - unit.size())] : json[column];
            list.push_back(value ? Json(rounded(*value, 3)) : Json());
        }
    return json;
}

Json evaluation_json(const RunEvaluation& evaluation)
{
    Json json = Json::object();
    for (const auto& metric : metrics_of(evaluation))
        json[metric.key] = metric.value ? Json(*metric.value) : Json();
    return json;
}

std::vector<std::string> remarks_on(const Json& summary, const std::optional<ReportTruth>& truth)
{
    std::vector<std::string> remarks;
    if (const auto ended = summary.value("ended_early", ""); !ended.empty())
        remarks.push_back("This run is not complete: " + ended + ".");
    if (!truth) return remarks;
    remarks.push_back("Ground truth: " + truth->description.file + ", " +
                      truth->description.content + "; " + to_word(truth->description.protocol) +
                      ": " + rule_of(truth->description.protocol) + ".");
    for (const auto& remark : truth->description.remarks) remarks.push_back(remark);
    return remarks;
}

std::string why_no_map(const Json& summary)
{
    if (auto ended = summary.value("ended_early", ""); !ended.empty()) return ended;
    for (const auto& note : summary.value("map", Json::object()).value("notes", Json::array()))
        if (auto text = note.get<std::string>(); text.rfind("no map", 0) == 0) return text;
    return "this run has no poses.csv, no trajectory_input.tum and no trajectory_optimized.tum, "
           "nor "
           ".kitti";
}
}  // namespace

RunFolder read_run_folder(const std::string& path)
{
    RunFolder run{
        path, read_summary(path + "/summary.json"), read_frames_csv(path + "/frames.csv")};
    const auto& counts = run.summary.value("frames", Json::object());
    const auto expected = counts.value("camera_frames", run.frames.size());
    if (expected != run.frames.size())
        throw std::runtime_error(path + "/frames.csv has " + std::to_string(run.frames.size()) +
                                 " frames, summary.json beside it " + std::to_string(expected) +
                                 "; is it cut off?");
    return run;
}

Json run_json(const RunFolder& run, const std::optional<ReportTruth>& truth)
{
    const auto trajectories = read_trajectories(run, truth);
    Json json;
    json["summary"] = run.summary;
    json["remarks"] = remarks_on(run.summary, truth);
    json["frames"] = frames_json(run.frames);
    json["loops"] = loops_json(run.frames, run.path + "/loops.csv", trajectories);
    json["trajectories"] = Json::object();
    for (const auto& [name, poses] : trajectories)
        json["trajectories"][name] = positions_json(poses);
    json["no_map_reason"] = why_no_map(run.summary);
    if (fs::exists(run.path + "/costs.csv")) json["costs"] = costs_json(run.path + "/costs.csv");
    if (truth) json["evaluation"] = evaluation_json(truth->evaluation);
    return json;
}

}  // namespace fild
