// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/loop_truth.h"
#include "fild/results/candidates_csv.h"

#include <vector>

namespace fild
{
/** A candidate whose evidence was measured, and what the truth says of it. */
struct JudgedPair
{
    FrameId query{};
    ConsideredCandidate considered;
    Judgement judgement = Judgement::neither;
};

/** The candidates that have odds, in the order of frames and answers. */
std::vector<JudgedPair> judge_pairs(const AnswersOfFrames& answers, const LoopTruth& truth);

}  // namespace fild
