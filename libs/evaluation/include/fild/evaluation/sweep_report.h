// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/evaluation/run_evaluation.h"
#include "fild/evaluation/truth_description.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** One choice of values, and the runs with it. */
struct SweepPoint
{
    std::vector<std::string> values;  ///< one for each key of the sweep
    std::vector<RunEvaluation> runs;  ///< one for each seed, at least one
    std::vector<int> seeds;  ///< of `runs`
    StageTimes times;  ///< of all of them
};

/** What became of runs with several values of the configuration and several seeds. */
struct SweepReport
{
    std::string rawlog;
    std::string config;
    std::vector<std::string> overrides;  ///< "section.key=value", in force at all points
    std::vector<std::string> remarks;  ///< on the recording
    TruthDescription truth;
    std::vector<std::string> keys;  ///< "section.key"; may be none
    std::vector<SweepPoint> points;
    std::string ended_early;  ///< empty: all points are there
};

/** An aligned table with a row for each point, and its wrong loops.
 *  \param max_wrong  wrong loops that are listed. */
std::string to_text(const SweepReport& report, std::size_t max_wrong);

/** Writes into the folder, made if need be, each file whole or not at all: sweep.csv (a row for
 *  each point), sweep_runs.csv (for each point and seed), sweep_wrong_loops.csv, sweep_pairs.csv
 *  (each pair whose evidence was measured, and the truth about it), sweep.tex (a table
 *  for LaTeX, package booktabs) and sweep.svg (the scores and times over the values of the first
 *  key). \throw std::runtime_error naming what cannot be written. */
void write_sweep(const SweepReport& report, const std::string& folder);

}  // namespace fild
