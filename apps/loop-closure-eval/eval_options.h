// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/trajectory_error.h"
#include "sweep.h"
#include "truth.h"

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** The command line of loop-closure-eval. */
struct EvalOptions
{
    std::vector<std::string> runs;  ///< at least one, unless there is a sweep
    TruthOptions truth;
    std::vector<std::string> trajectories;  ///< instead of those in the run's folder
    TrajectoryErrorOptions trajectory_error;
    std::optional<SweepRequest> sweep;  ///< instead of `runs`
    std::string output;  ///< empty: nothing is written
};

/** Nothing when --help or --version was all that was asked for. \throw WrongUsage */
std::optional<EvalOptions> parse_eval_options(int argc, char** argv);

}  // namespace fild
