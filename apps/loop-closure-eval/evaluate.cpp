// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate.h"

#include "fild/evaluation/ground_truth.h"
#include "fild/evaluation/run_evaluation.h"
#include "fild/rawlog/recorded_path.h"

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
bool is_rawlog(const std::string& path)
{
    const std::filesystem::path name(path);
    return name.extension() == ".rawlog" ||
           (name.extension() == ".gz" && name.stem().extension() == ".rawlog");
}

TimedPose to_timed_pose(const StampedPose& stamped)
{
    TimedPose timed;
    timed.timestamp = stamped.seconds;
    timed.pose.position = {stamped.x, stamped.y, stamped.z};
    timed.pose.rotation = rotation_of({stamped.qx, stamped.qy, stamped.qz, stamped.qw});
    return timed;
}

TruePoses true_poses_in_rawlog(const std::string& path,
                               const std::string& sensor,
                               const std::vector<FrameVerdict>& frames)
{
    const auto recorded = read_recorded_path(path, sensor);
    const bool gps = recorded.source == RecordedPath::Source::gps;
    MeasuredPath measured;
    measured.oriented = !gps;
    measured.poses.reserve(recorded.poses.size());
    for (const auto& pose : recorded.poses) measured.poses.push_back(to_timed_pose(pose));
    const auto content =
        std::string(gps ? "GPS" : "robot poses") + " '" + recorded.sensor_label + "'";
    return true_poses_along(measured, content, frames);
}

GroundTruth load(const EvalOptions& options, const std::vector<FrameVerdict>& frames)
{
    if (is_rawlog(options.ground_truth))
        return ground_truth_of(
            true_poses_in_rawlog(options.ground_truth, options.truth_sensor, frames),
            options.protocol);
    if (!options.truth_sensor.empty() && !is_rawlog(options.true_trajectory))
        throw std::invalid_argument("--truth-sensor is for a rawlog as ground truth");
    return load_ground_truth(options.ground_truth, frames, options.protocol);
}

/** True poses to compare trajectories with, if there are any. */
std::optional<TruePoses> load_trajectory_truth(const EvalOptions& options,
                                               std::optional<TruePoses> of_ground_truth,
                                               const std::vector<FrameVerdict>& frames)
{
    const auto& path = options.true_trajectory;
    if (path.empty()) return of_ground_truth;
    return is_rawlog(path) ? true_poses_in_rawlog(path, options.truth_sensor, frames)
                           : load_true_poses(path, frames);
}

void take_trajectories(const std::vector<std::string>& paths, RunResults& run)
{
    if (paths.empty()) return;
    run.trajectories.clear();
    for (const auto& path : paths)
    {
        const auto name = std::filesystem::path(path).stem().string();
        for (const auto& other : run.trajectories)
            if (other.first == name)
                throw std::invalid_argument("two trajectories are named " + name);
        run.trajectories.emplace_back(name, read_tum_trajectory(path));
    }
}

std::vector<RunResults> read_runs(const EvalOptions& options)
{
    std::vector<RunResults> runs;
    runs.reserve(options.runs.size());
    for (const auto& folder : options.runs)
    {
        runs.push_back(read_run(folder));
        take_trajectories(options.trajectories, runs.back());
    }
    require_same_recording(runs);
    return runs;
}
std::vector<std::string> remarks_on(const std::vector<RunResults>& runs)
{
    std::string folders;
    for (const auto& run : runs)
        if (!run.answers) folders += (folders.empty() ? "" : ", ") + run.folder;
    if (folders.empty()) return {};
    return {"no candidates.csv in " + folders + ": no candidate recall, no stages of loss"};
}
}  // namespace

EvaluationReport evaluate(const EvalOptions& options)
{
    const auto runs = read_runs(options);
    const auto& frames = runs.front().frames;
    auto ground_truth = load(options, frames);
    const auto true_poses = load_trajectory_truth(options, std::move(ground_truth.poses), frames);
    if (!true_poses && !options.trajectories.empty())
        throw std::invalid_argument(
            "--trajectory needs --true-trajectory: the ground truth is "
            "labels");
    EvaluationReport report;
    report.ground_truth_file = options.ground_truth;
    report.ground_truth_content = ground_truth.content;
    report.ground_truth_remarks = ground_truth.remarks;
    report.protocol = options.protocol;
    for (const auto& run : runs)
    {
        report.runs.push_back(evaluate_loops(run, *ground_truth.truth));
        if (true_poses)
            report.runs.back().trajectories =
                evaluate_trajectories(run, *true_poses, options.trajectory_error);
    }
    report.run_remarks = remarks_on(runs);
    return report;
}

}  // namespace fild
