// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/run_evaluation.h"

#include "fild/evaluation/frames_csv.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
constexpr double kSameTime = 1e-5;  // seconds; frames.csv has six decimals

CandidateEvaluation evaluate_candidates(const std::vector<JudgedFrame>& frames,
                                        const AnswersOfFrames& answers,
                                        const LoopTruth& truth)
{
    CandidateEvaluation evaluation;
    for (std::size_t i = 0; i < kCandidateRanks.size(); ++i)
        evaluation.recall.at(i) = candidate_recall(frames, answers, truth, kCandidateRanks.at(i));
    evaluation.lost = lost_loops(frames, answers, truth);
    return evaluation;
}
}  // namespace

std::optional<std::vector<TimedPose>> read_run_trajectory(const std::string& folder,
                                                          const std::string& name,
                                                          const std::vector<FrameVerdict>& frames)
{
    const auto path = (std::filesystem::path(folder) / ("trajectory_" + name)).string();
    if (std::filesystem::exists(path + ".tum")) return read_tum_trajectory(path + ".tum");
    if (!std::filesystem::exists(path + ".kitti")) return std::nullopt;
    std::vector<TimedPose> trajectory;
    for (const auto& frame : read_kitti_poses(path + ".kitti", frames))
        trajectory.push_back({frame.timestamp, *frame.pose});
    return trajectory;
}

RunResults read_run(const std::string& folder)
{
    const std::filesystem::path path(folder);
    RunResults run;
    run.folder = folder;
    run.frames = read_frames_csv((path / "frames.csv").string());
    if (const auto file = path / "candidates.csv"; std::filesystem::exists(file))
        run.answers = read_candidates_csv(file.string(), run.frames.size());
    for (const std::string name : {"input", "optimized"})
        if (auto trajectory = read_run_trajectory(folder, name, run.frames))
            run.trajectories.emplace_back(name, std::move(*trajectory));
    return run;
}

void require_same_recording(const std::vector<RunResults>& runs)
{
    const auto fail = [&](const RunResults& run, const std::string& what)
    {
        throw std::runtime_error(run.folder + " has " + what + " than " + runs.front().folder +
                                 "; only runs of one recording are evaluated together");
    };
    for (const auto& run : runs)
    {
        const auto& first = runs.front().frames;
        if (run.frames.size() != first.size())
            fail(run,
                 "another number of frames (" + std::to_string(run.frames.size()) + ", not " +
                     std::to_string(first.size()) + ")");
        for (std::size_t i = 0; i < first.size(); ++i)
            if (std::abs(run.frames[i].timestamp - first[i].timestamp) > kSameTime)
                fail(run, "another time of frame " + std::to_string(i));
    }
}

RunEvaluation evaluate_loops(const RunResults& run, const LoopTruth& truth)
{
    const auto frames = judge_frames(run.frames, truth);
    RunEvaluation evaluation;
    evaluation.folder = run.folder;
    evaluation.score = score_loops(frames);
    evaluation.inlier_curve = precision_recall_curve(frames, ScoreKind::inliers);
    evaluation.similarity_curve = precision_recall_curve(frames, ScoreKind::similarity);
    evaluation.stretches = loop_stretches(frames);
    evaluation.worst_wrong = worst_wrong_pair(frames);
    if (!run.answers) return evaluation;
    evaluation.candidates = evaluate_candidates(frames, *run.answers, truth);
    evaluation.pairs = judge_pairs(*run.answers, truth);
    return evaluation;
}

std::vector<NamedTrajectoryError> evaluate_trajectories(const RunResults& run,
                                                        const TruePoses& truth,
                                                        const TrajectoryErrorOptions& options)
{
    std::vector<NamedTrajectoryError> errors;
    errors.reserve(run.trajectories.size());
    for (const auto& [name, trajectory] : run.trajectories) try
        {
            errors.push_back(
                {name, trajectory_error(trajectory, truth.frames, truth.oriented, options)});
        }
        catch (const std::runtime_error& error)
        {
            throw std::runtime_error("trajectory " + name + " of " + run.folder + ": " +
                                     error.what());
        }
    return errors;
}

}  // namespace fild
