// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/run_evaluation.h"

#include "fild/results/frames_csv.h"
#include "fild/results/poses_csv.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
constexpr double kSameTime = 1e-5;  // seconds; frames.csv has six decimals

FramePose pose_of(const PoseNumbers& n)
{
    return {rotation_of({n[3], n[4], n[5], n[6]}), {n[0], n[1], n[2]}};
}

/** Out of poses.csv; nothing when it is not there. */
std::optional<PosesOfFrames> poses_by_frame(const std::string& folder,
                                            const std::string& name,
                                            const std::vector<FrameVerdict>& frames)
{
    const auto path = std::filesystem::path(folder) / "poses.csv";
    if (!std::filesystem::exists(path)) return std::nullopt;
    const auto numbers = name == "input" ? &PoseRow::input : &PoseRow::optimized;
    PosesOfFrames poses;
    for (const auto& row : read_poses_csv(path.string(), frames.size()))
        poses.push_back(row ? std::optional(pose_of((*row).*numbers)) : std::nullopt);
    return poses;
}

/** The pose nearest in time to each frame. Times are rounded to 1e-6 s in frames.csv, and doubles
 *  of this size to 2e-7 s. */
PosesOfFrames joined_by_time(const std::vector<TimedPose>& trajectory,
                             const std::vector<FrameVerdict>& frames)
{
    constexpr double kRounding = 2e-6;
    std::map<double, const FramePose*> pose_at;
    for (const auto& pose : trajectory) pose_at.emplace(pose.timestamp, &pose.pose);
    PosesOfFrames poses(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        const double time = frames[i].timestamp;
        auto nearest = pose_at.lower_bound(time - kRounding);
        if (nearest == pose_at.end() || nearest->first > time + kRounding) continue;
        for (auto next = std::next(nearest); next != pose_at.end(); nearest = next++)
            if (std::abs(next->first - time) >= std::abs(nearest->first - time)) break;
        poses[i] = *nearest->second;
    }
    return poses;
}

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

std::optional<PosesOfFrames> read_run_poses(const std::string& folder,
                                            const std::string& name,
                                            const std::vector<FrameVerdict>& frames)
{
    if (auto poses = poses_by_frame(folder, name, frames)) return poses;
    const auto trajectory = read_run_trajectory(folder, name, frames);
    if (!trajectory) return std::nullopt;
    return joined_by_time(*trajectory, frames);
}

std::vector<TimedPose> timed_poses(const PosesOfFrames& poses,
                                   const std::vector<FrameVerdict>& frames)
{
    std::vector<TimedPose> timed;
    for (std::size_t i = 0; i < poses.size(); ++i)
        if (poses[i]) timed.push_back({frames.at(i).timestamp, *poses[i]});
    std::stable_sort(timed.begin(),
                     timed.end(),
                     [](const auto& a, const auto& b) { return a.timestamp < b.timestamp; });
    return timed;
}

std::optional<std::vector<TimedPose>> read_run_trajectory(const std::string& folder,
                                                          const std::string& name,
                                                          const std::vector<FrameVerdict>& frames)
{
    if (const auto poses = poses_by_frame(folder, name, frames)) return timed_poses(*poses, frames);
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
    RunEvaluation evaluation;
    evaluation.folder = run.folder;
    evaluation.frames = judge_frames(run.frames, truth);
    const auto& frames = evaluation.frames;
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
