// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eval_options.h"
#include "fild/evaluation/evaluation_report.h"

namespace fild
{
/** Reads runs and ground truth, and scores each run.
 *  \throw std::runtime_error, std::invalid_argument as the readers. */
EvaluationReport evaluate(const EvalOptions& options);

}  // namespace fild
