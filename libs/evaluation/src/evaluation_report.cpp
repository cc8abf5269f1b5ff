// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/evaluation_report.h"

#include "evaluation_parts.h"
#include "fild/core/whole_file.h"

#include <algorithm>
#include <filesystem>

namespace fild
{
std::string match_picture_of(const std::string& run_folder, const FrameVerdict& verdict)
{
    const auto picture = "matches/" + std::to_string(to_index(verdict.frame)) + "_" +
                         std::to_string(to_index(verdict.candidate->frame)) + ".jpg";
    std::error_code unreadable_is_absent;
    const auto path = std::filesystem::path(run_folder) / picture;
    return std::filesystem::exists(path, unreadable_is_absent) ? picture : "";
}

std::vector<std::vector<Metric>> metrics_of_runs(const EvaluationReport& report)
{
    std::vector<std::vector<Metric>> metrics;
    metrics.reserve(report.runs.size());
    for (const auto& run : report.runs) metrics.push_back(metrics_of(run));
    return metrics;
}

void write_wrong_and_missed_loops(const EvaluationReport& report, const std::string& folder)
{
    const std::filesystem::path path(folder);
    write_whole_file(path / "wrong_loops.csv", wrong_loops_csv(report));
    const bool know_candidates =
        std::all_of(report.runs.begin(),
                    report.runs.end(),
                    [](const RunEvaluation& run) { return run.candidates; });
    if (know_candidates) write_whole_file(path / "missed_loops.csv", missed_loops_csv(report));
}

void write_evaluation(const EvaluationReport& report, const std::string& folder)
{
    const auto path = make_folder(folder);
    write_wrong_and_missed_loops(report, folder);
    write_whole_file(path / "curve_inliers.csv", curve_csv(report, ScoreKind::inliers));
    write_whole_file(path / "curve_similarity.csv", curve_csv(report, ScoreKind::similarity));
    write_whole_file(path / "stretches.csv", stretches_csv(report));
    write_whole_file(path / "runs.csv", runs_csv(report));
    write_whole_file(path / "evaluation.tex", evaluation_tex(report));
    const auto plot = precision_recall_plot(report);
    write_whole_file(path / "precision_recall.svg", plot.svg());
    write_whole_file(path / "precision_recall.png", plot.png());
    write_whole_file(path / "evaluation.json", evaluation_json(report));
}

}  // namespace fild
