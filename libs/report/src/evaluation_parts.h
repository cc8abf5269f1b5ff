// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/metric.h"
#include "fild/report/evaluation_report.h"
#include "plot.h"

#include <string>
#include <vector>

namespace fild
{
/** metrics_of() each run. */
std::vector<std::vector<Metric>> metrics_of_runs(const EvaluationReport& report);

/** A value as text: whole counts without decimals, others with three (of a mean count: one). Of
 *  shares only what is perfect reads 1.000, and only what is nothing 0.000. */
std::string format_value(double value, Metric::Kind kind);

/** The mean, with the least and the greatest value if there are several runs: `0.5 [0.4, 0.6]`; `-`
 *  without any value. */
std::string format_range(const MetricRange& range, bool several);

/** The content of evaluation.json. */
std::string evaluation_json(const EvaluationReport& report);

/** The content of evaluation.tex: a table for LaTeX, package booktabs. */
std::string evaluation_tex(const EvaluationReport& report);

/** The curves of all runs over inliers and over similarity, of a single run with thresholds, and
 *  where the runs themselves are. */
VectorPlot precision_recall_plot(const EvaluationReport& report);

/** Contents of the CSV files. */
std::string wrong_loops_csv(const EvaluationReport& report);
std::string curve_csv(const EvaluationReport& report, ScoreKind kind);
std::string stretches_csv(const EvaluationReport& report);
std::string missed_loops_csv(const EvaluationReport& report);
std::string runs_csv(const EvaluationReport& report);

}  // namespace fild
