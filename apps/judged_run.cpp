// SPDX-License-Identifier: BSD-3-Clause
#include "judged_run.h"

#include "fild/evaluation/run_evaluation.h"

namespace fild
{
ReportTruth judge_run(const std::string& folder, const TruthOptions& options)
{
    const auto run = read_run(folder);
    const auto truth = load_truth(options, run.frames);
    ReportTruth judged;
    judged.description = {options.file, truth.content, truth.remarks, options.protocol};
    judged.evaluation = evaluate_loops(run, *truth.truth);
    if (!truth.poses) return judged;
    judged.evaluation.trajectories = evaluate_trajectories(run, *truth.poses, {});
    judged.poses = truth.poses->frames;
    return judged;
}

}  // namespace fild
