// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/frame_poses.h"
#include "fild/evaluation/run_evaluation.h"
#include "fild/report/report_options.h"
#include "fild/report/truth_description.h"

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** What is known beside the run's own results, when there is ground truth. */
struct ReportTruth
{
    TruthDescription description;
    RunEvaluation evaluation;  ///< of the run
    std::vector<PosedFrame> poses;  ///< of the frames; empty: the truth is labels
};

/** Makes report.html in the folder of a run out of the files that are there: frames.csv and
 *  summary.json at least; loops.csv, costs.csv, trajectory_input.tum, trajectory_optimized.tum,
 *  map_top.png, map_perspective.png, similarity.png and matches/ if they are. One file, which needs
 *  neither network nor other files; panels without content say why. The same folder gives the same
 *  report.
 *  \throw std::runtime_error naming the file that is missing, unreadable or not of a run. */
void write_html_report(const std::string& folder,
                       const TReportOptions& options,
                       const std::optional<ReportTruth>& truth = std::nullopt);

}  // namespace fild
