// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_parts.h"

#include <array>
#include <locale>
#include <sstream>
#include <utility>

namespace fild
{
namespace
{
/** What stands in the table, where the runs have it. */
constexpr std::array<std::pair<const char*, const char*>, 19> kRows{
    {{"loop_queries", "Loop queries"},
     {"accepted", "Loop closures"},
     {"wrong", "Wrong loop closures"},
     {"precision", "Precision"},
     {"recall", "Recall"},
     {"segment_recall", "Segment recall"},
     {"worst_wrong_support", "Support of the worst wrong pair"},
     {"recall_at_full_precision_inliers", "Recall at 100\\,\\% precision, by inliers"},
     {"max_f1_inliers", "Maximum $F_1$, by inliers"},
     {"average_precision_inliers", "Average precision, by inliers"},
     {"recall_at_full_precision_similarity", "Recall at 100\\,\\% precision, by similarity"},
     {"max_f1_similarity", "Maximum $F_1$, by similarity"},
     {"average_precision_similarity", "Average precision, by similarity"},
     {"candidate_recall_1", "Candidate recall at 1"},
     {"candidate_recall_5", "Candidate recall at 5"},
     {"candidate_recall_10", "Candidate recall at 10"},
     {"ate_input_m", "ATE before optimisation, m"},
     {"ate_optimized_m", "ATE after optimisation, m"},
     {"ate_optimized_scale", "Scale of the alignment"}}};

std::string row_of(const MetricRange& range, const std::string& title, bool several)
{
    const auto kind = range.metric.kind;
    std::string row = title + " & " + format_value(*range.metric.value, kind);
    if (several)
        row += " & " + format_value(range.min, kind) + " & " + format_value(range.max, kind);
    return row + " \\\\\n";
}
}  // namespace

std::string evaluation_tex(const EvaluationReport& report)
{
    const bool several = report.runs.size() > 1;
    std::ostringstream tex;
    tex.imbue(std::locale::classic());
    tex << "% " << rule_of(report.truth.protocol) << "\n% \\usepackage{booktabs}\n\\begin{tabular}{"
        << (several ? "lrrr" : "lr") << "}\n\\toprule\nProtocol \\texttt{"
        << to_word(report.truth.protocol) << "} & " << (several ? "mean & min & max" : "")
        << " \\\\\n\\midrule\n";
    const auto ranges = ranges_of(metrics_of_runs(report));
    for (const auto& [key, title] : kRows)
        for (const auto& range : ranges)
            if (range.metric.key == key && range.runs > 0) tex << row_of(range, title, several);
    tex << "\\bottomrule\n\\end{tabular}\n";
    return tex.str();
}

}  // namespace fild
