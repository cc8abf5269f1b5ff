// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/ground_truth.h"
#include "fild/evaluation/loop_score.h"
#include "fild/evaluation/protocol.h"

#include <string>
#include <vector>

namespace fild
{
/** What loop-closure-eval says of a run. */
struct EvaluationReport
{
    std::string run;  ///< folder
    std::string ground_truth_file;
    std::string ground_truth_content;
    std::vector<std::string> remarks;  ///< on the ground truth
    Protocol protocol;
    LoopScore score;
};

/** Aligned lines for a person; `max_wrong` wrong loops are listed. */
std::string to_text(const EvaluationReport& report, std::size_t max_wrong);

/** Writes evaluation.json and wrong_loops.csv into the folder, made if need be, each whole or not
 *  at all. \throw std::runtime_error naming what cannot be written. */
void write_report(const EvaluationReport& report, const std::string& folder);

}  // namespace fild
