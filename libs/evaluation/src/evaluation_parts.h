// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/evaluation_report.h"
#include "fild/evaluation/metric.h"
#include "plot.h"

#include <string>
#include <vector>

namespace fild
{
/** metrics_of() each run. */
std::vector<std::vector<Metric>> metrics_of_runs(const EvaluationReport& report);

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
