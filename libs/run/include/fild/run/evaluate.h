// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/evaluation_report.h"
#include "fild/evaluation/trajectory_error.h"
#include "fild/run/truth.h"

#include <string>
#include <vector>

namespace fild
{
/** Runs whose results are scored. */
struct EvaluationRequest
{
    std::vector<std::string> runs;  ///< folders, at least one
    TruthOptions truth;
    std::vector<std::string> trajectories;  ///< instead of those in the run's folder
    TrajectoryErrorOptions trajectory_error;
};

/** Reads runs and ground truth, and scores each run.
 *  \throw WrongUsage when the trajectories do not fit the request.
 *  \throw std::runtime_error, std::invalid_argument as the readers. */
EvaluationReport evaluate(const EvaluationRequest& request);

}  // namespace fild
