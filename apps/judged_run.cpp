// SPDX-License-Identifier: BSD-3-Clause
#include "judged_run.h"

#include "fild/evaluation/run_evaluation.h"
#include "fild/report/run_summary.h"

namespace fild
{
ReportTruth judge_run(const std::string& folder,
                      const TruthOptions& options,
                      std::optional<double> delay_seconds)
{
    const auto run = read_run(folder);
    const auto of_run =
        for_run(options, delay_seconds ? delay_seconds : read_run_delay(folder + "/summary.json"));
    const auto truth = load_truth(of_run, run.frames);
    ReportTruth judged;
    judged.description = {of_run.file, truth.content, truth.remarks, of_run.protocol};
    judged.evaluation = evaluate_loops(run, *truth.truth);
    if (!truth.poses) return judged;
    judged.evaluation.trajectories = evaluate_trajectories(run, *truth.poses, {});
    judged.poses = truth.poses->frames;
    return judged;
}

}  // namespace fild
