// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/ground_truth.h"
#include "fild/evaluation/judged_frame.h"
#include "fild/evaluation/judged_pair.h"
#include "fild/evaluation/loop_score.h"
#include "fild/evaluation/loop_stretch.h"
#include "fild/evaluation/lost_loop.h"
#include "fild/evaluation/precision_recall_curve.h"
#include "fild/evaluation/trajectory_error.h"
#include "fild/evaluation/worst_wrong_pair.h"
#include "fild/results/candidates_csv.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** What a run left in its folder for its evaluation. */
struct RunResults
{
    std::string folder;
    std::vector<FrameVerdict> frames;
    std::optional<AnswersOfFrames> answers;  ///< none: there is no candidates.csv
    /** `input` and `optimized`, those that are there; see read_run_trajectory(). */
    std::vector<std::pair<std::string, std::vector<TimedPose>>> trajectories;
};

/** Poses of a run, frame by frame, out of poses.csv; without that file, out of
 *  trajectory_NAME.tum, where a pose belongs to the frame of the same time to 2 microseconds, or
 *  trajectory_NAME.kitti. Nothing when none of them is there.
 *  \param name  `input` or `optimized`.
 *  \throw std::runtime_error naming the file. */
std::optional<PosesOfFrames> read_run_poses(const std::string& folder,
                                            const std::string& name,
                                            const std::vector<FrameVerdict>& frames);

/** The frames that have a pose, in the order of time. */
std::vector<TimedPose> timed_poses(const PosesOfFrames& poses,
                                   const std::vector<FrameVerdict>& frames);

/** The same poses as a trajectory in the order of time; those of trajectory_NAME.tum with its own
 *  times. \throw std::runtime_error naming the file. */
std::optional<std::vector<TimedPose>> read_run_trajectory(const std::string& folder,
                                                          const std::string& name,
                                                          const std::vector<FrameVerdict>& frames);

/** Reads frames.csv, and candidates.csv and the trajectories if they are there.
 *  \throw std::runtime_error naming the file. */
RunResults read_run(const std::string& folder);

/** \throw std::runtime_error unless all runs are of the same recording: as many frames, of the same
 *         times. Time stamps are compared to 1e-5 s. */
void require_same_recording(const std::vector<RunResults>& runs);

/** Ranks up to which candidate recall is counted. */
constexpr std::array<std::size_t, 3> kCandidateRanks = {1, 5, 10};

/** What index and verification made of the true candidates. */
struct CandidateEvaluation
{
    /** For each of kCandidateRanks; none: there is no loop query. */
    std::array<std::optional<double>, kCandidateRanks.size()> recall;
    std::vector<LostLoop> lost;
};

/** A trajectory of a run against the true poses. */
struct NamedTrajectoryError
{
    std::string name;  ///< "input"
    TrajectoryError error;
};

/** Everything that is said of one run. */
struct RunEvaluation
{
    std::string folder;
    std::vector<JudgedFrame> frames;
    LoopScore score;
    PrecisionRecallCurve inlier_curve;
    PrecisionRecallCurve similarity_curve;
    std::vector<LoopStretch> stretches;
    std::optional<WorstWrongPair> worst_wrong;  ///< none: no candidate was wrong
    std::optional<CandidateEvaluation> candidates;  ///< none: there is no candidates.csv
    std::vector<NamedTrajectoryError> trajectories;
    std::vector<JudgedPair> pairs;  ///< whose evidence was measured in this process, else empty
};

/** Scores a run's loop closures. \param truth  of its frames. */
RunEvaluation evaluate_loops(const RunResults& run, const LoopTruth& truth);

/** Compares the run's trajectories with the true poses.
 *  \throw std::runtime_error naming the trajectory. */
std::vector<NamedTrajectoryError> evaluate_trajectories(const RunResults& run,
                                                        const TruePoses& truth,
                                                        const TrajectoryErrorOptions& options);

}  // namespace fild
