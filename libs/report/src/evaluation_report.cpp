// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/evaluation_report.h"

#include "evaluation_parts.h"
#include "text_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

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

std::string format_value(double value, Metric::Kind kind)
{
    std::ostringstream text;
    text << std::fixed;
    if (kind == Metric::Kind::share && value > 0 && value < 1)
        value = std::clamp(value, 0.001, 0.999);
    if (kind == Metric::Kind::count)
        text << std::setprecision(value == std::floor(value) ? 0 : 1) << value;
    else
        text << std::setprecision(3) << value;
    return text.str();
}

std::string format_range(const MetricRange& range, bool several)
{
    if (range.runs == 0) return "-";
    const auto kind = range.metric.kind;
    auto mean = format_value(*range.metric.value, kind);
    if (!several) return mean;
    return mean + " [" + format_value(range.min, kind) + ", " + format_value(range.max, kind) + "]";
}

void write_wrong_and_missed_loops(const EvaluationReport& report, const std::string& folder)
{
    const std::filesystem::path path(folder);
    write_text_file(path / "wrong_loops.csv", wrong_loops_csv(report));
    const bool know_candidates =
        std::all_of(report.runs.begin(),
                    report.runs.end(),
                    [](const RunEvaluation& run) { return run.candidates; });
    if (know_candidates) write_text_file(path / "missed_loops.csv", missed_loops_csv(report));
}

void write_evaluation(const EvaluationReport& report, const std::string& folder)
{
    const auto path = make_folder(folder);
    write_wrong_and_missed_loops(report, folder);
    write_text_file(path / "curve_inliers.csv", curve_csv(report, ScoreKind::inliers));
    write_text_file(path / "curve_similarity.csv", curve_csv(report, ScoreKind::similarity));
    write_text_file(path / "stretches.csv", stretches_csv(report));
    write_text_file(path / "runs.csv", runs_csv(report));
    write_text_file(path / "evaluation.tex", evaluation_tex(report));
    const auto plot = precision_recall_plot(report);
    write_text_file(path / "precision_recall.svg", plot.svg());
    write_text_file(path / "precision_recall.png", plot.png());
    write_text_file(path / "evaluation.json", evaluation_json(report));
}

}  // namespace fild
