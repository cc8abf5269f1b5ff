// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/run_evaluation.h"
#include "fild/evaluation/truth_description.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** What loop-closure-eval says of one or several runs of a recording. */
struct EvaluationReport
{
    TruthDescription truth;
    std::vector<std::string> run_remarks;
    std::vector<RunEvaluation> runs;  ///< at least one
};

/** Path of a loop closure's picture relative to the run's folder, as rawlog-loop-closure names it;
 *  empty when there is none. */
std::string match_picture_of(const std::string& run_folder, const FrameVerdict& verdict);

/** Aligned lines for a person. One run: each metric with its value; several: mean [min, max], then
 *  a table with a row for each run. \param max_wrong  wrong loops that are listed of each run. */
std::string to_text(const EvaluationReport& report, std::size_t max_wrong);

/** Writes wrong_loops.csv and, if all runs have a candidates.csv, missed_loops.csv into the folder.
 *  \throw std::runtime_error naming what cannot be written. */
void write_wrong_and_missed_loops(const EvaluationReport& report, const std::string& folder);

/** Writes into the folder, made if need be, each file whole or not at all: evaluation.json,
 *  evaluation.tex, precision_recall.svg, precision_recall.png and, with a first column `run` that
 *  counts from 1, wrong_loops.csv, curve_inliers.csv, curve_similarity.csv, stretches.csv, runs.csv
 *  and, if all runs have a candidates.csv, missed_loops.csv.
 *  \throw std::runtime_error naming what cannot be written. */
void write_evaluation(const EvaluationReport& report, const std::string& folder);

}  // namespace fild
