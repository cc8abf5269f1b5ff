// SPDX-License-Identifier: BSD-3-Clause
#include "run_folder.h"

#include "csv_table.h"
#include "data_url.h"
#include "fild/evaluation/frames_csv.h"
#include "fild/evaluation/metric.h"
#include "fild/report/evaluation_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/** With so many decimals: a report is read by people, and shorter so. */
double rounded(double value, int decimals)
{
    const double scale = std::pow(10, decimals);
    return std::round(value * scale) / scale;
}

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

/** Length of the vector of three columns, if they are filled. */
std::optional<double> length_of(const CsvTable& table,
                                std::size_t row,
                                const std::array<const char*, 3>& columns)
{
    double squares = 0;
    for (const auto* column : columns)
    {
        const auto value = table.number(row, column);
        if (!value) return std::nullopt;
        squares += *value * *value;
    }
    return std::sqrt(squares);
}

Json loops_json(const std::vector<FrameVerdict>& frames, const std::string& loops_csv)
{
    Json loops = Json::array();
    for (const auto& frame : frames)
        if (frame.accepted())
            loops.push_back({{"query", to_index(frame.frame)},
                             {"candidate", to_index(frame.candidate->frame)},
                             {"inliers", frame.inliers}});
    if (!fs::exists(loops_csv)) return loops;
    const CsvTable table(loops_csv);
    if (table.rows() != loops.size())
        throw std::runtime_error(loops_csv + " does not have the loop closures of frames.csv");
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        if (const auto weight = table.number(row, "weight")) loops[row]["weight"] = *weight;
        if (const auto edge = table.text(row, "edge"); !edge.empty()) loops[row]["edge"] = edge;
        if (const auto sigma = length_of(table, row, {"sigma_x", "sigma_y", "sigma_z"}))
            loops[row]["translation_sd_m"] = rounded(*sigma, 5);
    }
    return loops;
}

/** `count` of the indices below `size`, evenly, the first and the last among them. */
std::vector<std::size_t> spread(std::size_t count, std::size_t size)
{
    std::vector<std::size_t> chosen;
    count = std::min(count, size);
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(count == 1 ? 0 : i * (size - 1) / (count - 1));
    return chosen;
}

/** Match pictures that are there: those of rejected pairs and of the weakest loops for certain. */
Json pictures_json(const std::string& folder,
                   const std::vector<FrameVerdict>& frames,
                   const TReportOptions& options)
{
    std::vector<const FrameVerdict*> accepted;
    std::vector<const FrameVerdict*> chosen;
    for (const auto& frame : frames)
        if (frame.candidate && !match_picture_of(folder, frame).empty())
            (frame.accepted() ? accepted : chosen).push_back(&frame);
    std::stable_sort(accepted.begin(),
                     accepted.end(),
                     [](const auto* a, const auto* b) { return a->support < b->support; });
    const auto limit = static_cast<std::size_t>(options.max_pictures);
    chosen.resize(std::min(chosen.size(), limit));
    for (const auto i : spread(limit - chosen.size(), accepted.size()))
        chosen.push_back(accepted[i]);
    Json pictures = Json::object();
    for (const auto* frame : chosen)
    {
        const auto key = std::to_string(to_index(frame->frame)) + "_" +
                         std::to_string(to_index(frame->candidate->frame));
        pictures[key] = data_url_of_picture(folder + "/" + match_picture_of(folder, *frame),
                                            options.picture_width_px);
    }
    return pictures;
}

/** x, y, z and, where a camera frame was taken there, its number. */
Json trajectory_json(const std::vector<TimedPose>& poses, const std::vector<FrameVerdict>& frames)
{
    std::map<double, std::size_t> frame_at;  // microseconds are what the files hold
    for (const auto& frame : frames)
        frame_at.emplace(std::round(frame.timestamp * 1e5), to_index(frame.frame));
    Json json = Json::array();
    for (const auto& pose : poses)
    {
        Json point = Json::array();
        for (int axis = 0; axis < 3; ++axis) point.push_back(rounded(pose.pose.position[axis], 3));
        const auto frame = frame_at.find(std::round(pose.timestamp * 1e5));
        point.push_back(frame == frame_at.end() ? Json() : Json(frame->second));
        json.push_back(point);
    }
    return json;
}

Json trajectories_json(const std::string& folder,
                       const std::vector<FrameVerdict>& frames,
                       const std::optional<ReportTruth>& truth)
{
    Json json = Json::object();
    const bool has_poses = truth && !truth->poses.empty();
    for (const std::string name : {"input", "optimized"})
    {
        const auto path = folder + "/trajectory_" + name + ".tum";
        if (!fs::exists(path)) continue;
        auto poses = read_tum_trajectory(path);
        if (has_poses) poses = aligned_with(poses, truth->poses);
        json[name] = trajectory_json(poses, frames);
    }
    if (!has_poses) return json;
    std::vector<TimedPose> poses;
    for (const auto& frame : truth->poses)
        if (frame.pose) poses.push_back({frame.timestamp, *frame.pose});
    json["truth"] = trajectory_json(poses, frames);
    return json;
}

Json map_pictures_json(const std::string& folder)
{
    Json json = Json::object();
    for (const auto& [name, title] : {std::pair{"map_top.png", "from above"},
                                      std::pair{"map_perspective.png", "in perspective"}})
        if (fs::exists(folder + "/" + name)) json[title] = data_url_of_png(folder + "/" + name);
    return json;
}

/** Columns of costs.csv, at most kMostRows rows of it. */
Json costs_json(const std::string& path)
{
    constexpr std::size_t kMostRows = 2000;
    const CsvTable table(path);
    Json json = {{"frame", Json::array()}, {"ms", Json::object()}};
    const std::string unit = "_ms";
    for (const auto row : spread(kMostRows, table.rows()))
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
        remarks.push_back("The run did not reach the end of the rawlog: " + ended + ".");
    if (!truth) return remarks;
    remarks.push_back("Ground truth: " + truth->description.file + ", " +
                      truth->description.content + "; " + to_word(truth->description.protocol) +
                      ": " + rule_of(truth->description.protocol) + ".");
    for (const auto& remark : truth->description.remarks) remarks.push_back(remark);
    return remarks;
}

std::string why_no_map(const Json& summary)
{
    if (summary.contains("graph") && summary["graph"].contains("notes"))
        for (const auto& note : summary["graph"]["notes"]) return note.get<std::string>();
    return "no trajectory: the recording has no odometry, and its images no depth";
}
}  // namespace

Json read_run_folder(const std::string& folder,
                     const TReportOptions& options,
                     const std::optional<ReportTruth>& truth)
{
    const auto summary = read_summary(folder + "/summary.json");
    const auto frames = read_frames_csv(folder + "/frames.csv");
    Json run;
    run["summary"] = summary;
    run["remarks"] = remarks_on(summary, truth);
    run["frames"] = frames_json(frames);
    run["loops"] = loops_json(frames, folder + "/loops.csv");
    run["pictures"] = pictures_json(folder, frames, options);
    run["trajectories"] = trajectories_json(folder, frames, truth);
    run["map_pictures"] = map_pictures_json(folder);
    run["no_map_reason"] = why_no_map(summary);
    if (fs::exists(folder + "/similarity.png"))
        run["similarity"] = data_url_of_png(folder + "/similarity.png");
    if (fs::exists(folder + "/costs.csv")) run["costs"] = costs_json(folder + "/costs.csv");
    if (truth) run["evaluation"] = evaluation_json(truth->evaluation);
    return run;
}

}  // namespace fild
