// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/run/evaluate.h"
#include "fild/run/sweep.h"

#include <optional>
#include <string>

namespace fild
{
/** The command line of loop-closure-eval. */
struct EvalOptions
{
    EvaluationRequest evaluation;
    std::optional<SweepRequest> sweep;  ///< instead of `evaluation`
    std::string output;  ///< empty: nothing is written
};

/** Nothing when --help or --version was all that was asked for. \throw WrongUsage */
std::optional<EvalOptions> parse_eval_options(int argc, char** argv);

}  // namespace fild
