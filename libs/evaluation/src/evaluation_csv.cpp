// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_parts.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace fild
{
namespace
{
/** Hands each run to `write` with its number. */
template <class Write>
std::string rows_of_runs(const EvaluationReport& report, const std::string& header, Write&& write)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << header << '\n' << std::fixed << std::setprecision(6);
    for (std::size_t i = 0; i < report.runs.size(); ++i) write(out, i + 1, report.runs[i]);
    return out.str();
}
}  // namespace

std::string wrong_loops_csv(const EvaluationReport& report)
{
    const auto write = [](std::ostream& out, std::size_t number, const RunEvaluation& run)
    {
        for (const auto& [verdict, loop_query] : run.score.wrong_loops)
            out << number << ',' << to_index(verdict.frame) << ','
                << to_index(verdict.candidate->frame) << ',' << verdict.candidate->similarity << ','
                << verdict.matches << ',' << verdict.inliers << ',' << (loop_query ? 1 : 0) << ','
                << match_picture_of(run.folder, verdict) << '\n';
    };
    return rows_of_runs(
        report, "run,frame,candidate,similarity,matches,inliers,loop_query,picture", write);
}

std::string curve_csv(const EvaluationReport& report, ScoreKind kind)
{
    const auto write = [&](std::ostream& out, std::size_t number, const RunEvaluation& run)
    {
        const auto& curve = kind == ScoreKind::inliers ? run.inlier_curve : run.similarity_curve;
        for (const auto& point : curve.points)
        {
            out << number << ',' << std::setprecision(kind == ScoreKind::inliers ? 0 : 6)
                << point.threshold << ',' << std::setprecision(6) << point.accepted << ','
                << point.precision << ',';
            if (point.recall) out << *point.recall;
            out << '\n';
        }
    };
    return rows_of_runs(report, "run,threshold,accepted,precision,recall", write);
}

std::string stretches_csv(const EvaluationReport& report)
{
    const auto write = [](std::ostream& out, std::size_t number, const RunEvaluation& run)
    {
        for (const auto& stretch : run.stretches)
            out << number << ',' << to_index(stretch.first) << ',' << to_index(stretch.last) << ','
                << stretch.loop_queries << ',' << stretch.answered << '\n';
    };
    return rows_of_runs(report, "run,first,last,loop_queries,answered", write);
}

std::string missed_loops_csv(const EvaluationReport& report)
{
    const auto write = [](std::ostream& out, std::size_t number, const RunEvaluation& run)
    {
        for (const auto& lost : run.candidates->lost)
            out << number << ',' << to_index(lost.frame) << ',' << to_word(lost.stage) << '\n';
    };
    return rows_of_runs(report, "run,frame,stage", write);
}

std::string runs_csv(const EvaluationReport& report)
{
    std::string header = "run";
    // Keys of all runs: one may have a trajectory that another has not.
    const auto columns = ranges_of(metrics_of_runs(report));
    for (const auto& column : columns) header += ',' + column.metric.key;
    const auto write = [&](std::ostream& out, std::size_t number, const RunEvaluation& run)
    {
        const auto metrics = metrics_of(run);
        out << number;
        for (const auto& column : columns)
        {
            out << ',';
            for (const auto& metric : metrics)
                if (metric.key == column.metric.key && metric.value)
                    out << std::setprecision(metric.kind == Metric::Kind::count ? 0 : 6)
                        << *metric.value;
        }
        out << '\n';
    };
    return rows_of_runs(report, header, write);
}

}  // namespace fild
