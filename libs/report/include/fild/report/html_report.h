// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/frame_poses.h"
#include "fild/evaluation/loop_score.h"
#include "fild/evaluation/protocol.h"
#include "fild/evaluation/run_evaluation.h"
#include "fild/evaluation/truth_description.h"
#include "fild/report/report_options.h"

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** The loop closures of a run, counted by another protocol. */
struct ProtocolScore
{
    Protocol protocol;
    LoopScore score;
};

/** What is known beside the run's own results, when there is ground truth. */
struct ReportTruth
{
    TruthDescription description;
    RunEvaluation evaluation;  ///< of the run
    std::vector<ProtocolScore> other_protocols;  ///< beside that of `description`
    std::vector<PosedFrame> poses;  ///< of the frames; empty: no true poses are known
    bool oriented = true;  ///< false: orientations of `poses` are headings out of the motion
};

/** Makes report.html in the folder of a run out of the files that are there: frames.csv and
 *  summary.json at least; loops.csv, costs.csv, poses.csv (else trajectory_input.tum and
 *  trajectory_optimized.tum), map_top.png, map_perspective.png, similarity.png and matches/ if they
 *  are. One file, which needs neither network nor other files; panels without content say why. The
 *  same folder gives the same report.
 *  \param truth  its poses are those of all frames, or none.
 *  \throw std::runtime_error naming the file that is missing, unreadable or not of a run. */
void write_html_report(const std::string& folder,
                       const TReportOptions& options,
                       const std::optional<ReportTruth>& truth = std::nullopt);

/** One side of a comparison. */
struct ComparedRun
{
    std::string folder;
    std::optional<ReportTruth> truth;
};

/** Makes a page that lays two runs of one recording side by side: their options where they differ,
 *  numbers, trajectories, and the loop closures that only one of them has, with match pictures. As
 *  write_html_report() in all else.
 *  \throw std::runtime_error also when the runs are not of the same frames. */
void write_html_comparison(const ComparedRun& first,
                           const ComparedRun& second,
                           const TReportOptions& options,
                           const std::string& path);

}  // namespace fild
