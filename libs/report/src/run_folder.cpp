// SPDX-License-Identifier: BSD-3-Clause
#include "run_folder.h"

#include "fild/core/spread.h"
#include "fild/core/words.h"
#include "fild/evaluation/metric.h"
#include "fild/results/costs_csv.h"
#include "fild/results/frames_csv.h"
#include "loop_edges.h"
#include "page_frames.h"
#include "report_pictures.h"
#include "rounded.h"

#include <algorithm>
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

/** How many frames have each verdict. */
Json verdicts_json(const std::vector<FrameVerdict>& frames)
{
    Json json = Json::object();
    for (const auto& frame : frames)
    {
        const std::string word = frame.accepted() ? "accepted" : to_word(frame.rejection);
        json[word] = json.value(word, 0) + 1;
    }
    return json;
}

/** Columns, not rows: shorter. `number`, where not all frames are in the page. */
Json frames_json(const std::vector<FrameVerdict>& frames, const std::vector<bool>& page)
{
    Json json;
    const bool is_whole = std::find(page.begin(), page.end(), false) == page.end();
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
        const auto number = to_index(frame.frame);
        if (!page.at(number)) continue;
        if (!is_whole) json["number"].push_back(number);
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

/** x, y, z, metres, for each frame of the page; null where it has no pose. Empty without any pose.
 *  */
Json positions_json(const PosesOfFrames& poses, const std::vector<bool>& page)
{
    Json json = Json::array();
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
        if (!page.at(i)) continue;
        const auto& pose = poses[i];
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
    Json json;
    for (const auto* column : {"frame", "ms", "map_bytes", "resident_bytes"})
        json[column] = Json::array();
    auto& stages = json["ms"] = Json::object();
    for (const auto* stage : kFrameStages) stages[stage] = Json::array();
    for (const auto& row : read_costs_csv(path, kMostRows))
    {
        json["frame"].push_back(to_index(row.frame));
        for (std::size_t i = 0; i < kFrameStages.size(); ++i)
            stages[kFrameStages.at(i)].push_back(rounded(row.stage_ms.at(i), 3));
        json["map_bytes"].push_back(row.map_bytes);
        json["resident_bytes"].push_back(row.resident_bytes ? Json(*row.resident_bytes) : Json());
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

/** All metrics that have a value, as a reader wants them. */
Json metrics_json(const RunEvaluation& evaluation)
{
    Json rows = Json::array();
    for (const auto& metric : metrics_of(evaluation))
        if (metric.value || !metric.left_out_without_value)
            rows.push_back(
                {{"group", metric.group},
                 {"name", metric.name},
                 {"value", metric.value ? format_value(*metric.value, metric.kind) : "-"},
                 {"meaning", metric.meaning}});
    return rows;
}

Json word_of(const std::optional<Judgement>& judgement)
{
    if (!judgement) return nullptr;
    return *judgement == Judgement::right   ? "right"
           : *judgement == Judgement::wrong ? "wrong"
                                            : "doubtful";
}

/** `judgement` of each frame's candidate, accepted or not; `missed`: each loop query without a
 *  right loop closure, a frame at its place and the stage that lost it, as far as they are known.
 *  */
Json truth_json(const RunEvaluation& evaluation, const std::vector<bool>& page)
{
    std::map<FrameId, LossStage> stages;
    if (evaluation.candidates)
        for (const auto& lost : evaluation.candidates->lost) stages[lost.frame] = lost.stage;
    Json json = {{"judgement", Json::array()}, {"missed", Json::array()}};
    for (const auto& frame : evaluation.frames)
    {
        if (!page.at(to_index(frame.verdict.frame))) continue;
        json["judgement"].push_back(word_of(frame.judgement));
        if (!frame.loop_query || frame.answered()) continue;
        Json missed = {{"frame", to_index(frame.verdict.frame)}};
        if (frame.true_candidate) missed["place"] = to_index(*frame.true_candidate);
        if (const auto stage = stages.find(frame.verdict.frame); stage != stages.end())
        {
            missed["stage"] = to_word(stage->second);
            missed["why"] = meaning_of(stage->second);
        }
        json["missed"].push_back(missed);
    }
    return json;
}

Json protocol_json(const ProtocolScore& scored)
{
    const auto& [protocol, score] = scored;
    const auto text = [](const std::optional<double>& share)
    { return share ? format_value(*share, Metric::Kind::share) : "-"; };
    return {{"name", to_word(protocol)},
            {"rule", rule_of(protocol)},
            {"precision", text(score.precision())},
            {"recall", text(score.recall())},
            {"right", score.right},
            {"wrong", score.wrong_loops.size()},
            {"doubtful", score.neither},
            {"missed", score.missed()}};
}

/** The protocol of the run's score first. */
Json protocols_json(const ReportTruth& truth)
{
    Json json = {protocol_json({truth.description.protocol, truth.evaluation.score})};
    for (const auto& scored : truth.other_protocols) json.push_back(protocol_json(scored));
    return json;
}

/** [recall, precision, threshold] of at most kMostPoints points, from the highest threshold down.
 *  */
Json curve_json(const PrecisionRecallCurve& curve)
{
    constexpr std::size_t kMostPoints = 500;
    Json json = Json::array();
    for (const auto i : spread_indices(kMostPoints, curve.points.size()))
        if (const auto& point = curve.points[i]; point.recall)
            json.push_back({rounded(*point.recall, 4),
                            rounded(point.precision, 4),
                            rounded(point.threshold, 4)});
    return json;
}

void add_truth(Json& json, const ReportTruth& truth, const std::vector<bool>& page)
{
    json["evaluation"] = evaluation_json(truth.evaluation);
    json["metrics"] = metrics_json(truth.evaluation);
    json["truth"] = truth_json(truth.evaluation, page);
    json["protocols"] = protocols_json(truth);
    json["curves"] = {{"inliers", curve_json(truth.evaluation.inlier_curve)},
                      {"similarity", curve_json(truth.evaluation.similarity_curve)}};
}

/** For each word of `rejection`, and for accepted frames, what it says. */
Json verdict_meanings_json()
{
    Json json = Json::object();
    for (const auto rejection : all_rejections())
        json[rejection == Rejection::none ? "accepted" : to_word(rejection)] =
            meaning_of(rejection);
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
        throw std::runtime_error(path + "/frames.csv has " + count_of(run.frames.size(), "frame") +
                                 ", summary.json beside it " + std::to_string(expected) +
                                 "; is it cut off?");
    return run;
}

Json run_json(const RunFolder& run,
              const std::optional<ReportTruth>& truth,
              const std::vector<bool>& page)
{
    const auto trajectories = read_trajectories(run, truth);
    Json json;
    json["summary"] = run.summary;
    json["remarks"] = remarks_on(run.summary, truth);
    if (auto note = note_on_frames(run, truth, page); !note.empty())
        json["remarks"].push_back(std::move(note));
    json["frame_count"] = run.frames.size();
    json["verdicts"] = verdicts_json(run.frames);
    json["frames"] = frames_json(run.frames, page);
    auto oriented = trajectories;
    if (truth && !truth->oriented) oriented.erase("truth");
    json["loops"] = loops_json(run.frames, run.path + "/loops.csv", oriented, page);
    json["trajectories"] = Json::object();
    for (const auto& [name, poses] : trajectories)
        json["trajectories"][name] = positions_json(poses, page);
    json["no_map_reason"] = why_no_map(run.summary);
    if (fs::exists(run.path + "/costs.csv")) json["costs"] = costs_json(run.path + "/costs.csv");
    json["verdict_meanings"] = verdict_meanings_json();
    if (truth) add_truth(json, *truth, page);
    return json;
}

}  // namespace fild
