// SPDX-License-Identifier: BSD-3-Clause
#include "fild/run/evaluate.h"

#include "fild/evaluation/run_evaluation.h"
#include "fild/job/wrong_usage.h"
#include "fild/results/run_summary.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

namespace fild
{
namespace
{
void take_trajectories(const std::vector<std::string>& paths, RunResults& run)
{
    if (paths.empty()) return;
    run.trajectories.clear();
    for (const auto& path : paths)
    {
        const auto name = std::filesystem::path(path).stem().string();
        for (const auto& other : run.trajectories)
            if (other.first == name) throw WrongUsage("two trajectories are named " + name);
        run.trajectories.emplace_back(name, read_tum_trajectory(path));
    }
}

std::vector<RunResults> read_runs(const EvaluationRequest& request)
{
    std::vector<RunResults> runs;
    runs.reserve(request.runs.size());
    for (const auto& folder : request.runs)
    {
        runs.push_back(read_run(folder));
        take_trajectories(request.trajectories, runs.back());
    }
    require_same_recording(runs);
    return runs;
}

/** Runs that are evaluated together are held to one least age of a candidate. */
std::optional<double> longest_delay(const std::vector<std::string>& folders)
{
    std::optional<double> longest;
    for (const auto& folder : folders)
        if (const auto delay = read_run_delay(folder + "/summary.json"))
            longest = std::max(longest.value_or(0), *delay);
    return longest;
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

EvaluationReport evaluate(const EvaluationRequest& request)
{
    const auto runs = read_runs(request);
    const auto& frames = runs.front().frames;
    const auto truth = for_run(request.truth, longest_delay(request.runs));
    auto ground_truth = load_truth(truth, frames);
    const auto true_poses = true_poses_for(truth, ground_truth, frames);
    if (!true_poses && !request.trajectories.empty())
        throw WrongUsage(
            "--trajectory needs --true-trajectory: the ground truth is "
            "labels");
    EvaluationReport report;
    report.truth = {truth.file, ground_truth.content, ground_truth.remarks, truth.protocol};
    for (const auto& run : runs)
    {
        report.runs.push_back(evaluate_loops(run, *ground_truth.truth));
        if (true_poses)
            report.runs.back().trajectories =
                evaluate_trajectories(run, *true_poses, request.trajectory_error);
    }
    report.run_remarks = remarks_on(runs);
    return report;
}

}  // namespace fild
