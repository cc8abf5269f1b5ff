// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/candidates_csv.h"
#include "fild/evaluation/judged_frame.h"
#include "fild/evaluation/loop_truth.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** The wrong pair that came nearest to being accepted. */
struct WorstWrongPair
{
    FrameId frame{};
    FrameId candidate{};
    std::size_t inliers = 0;
    bool accepted = false;
};

/** The pair of a frame and its candidate that has the most inliers of all that the truth calls
 *  wrong, accepted or not; of several the first. None when no candidate is wrong.
 *  \param answers  not empty: all candidates that were checked count too, not only the one in
 *                  frames.csv. */
std::optional<WorstWrongPair> worst_wrong_pair(const std::vector<JudgedFrame>& frames,
                                               const AnswersOfFrames& answers,
                                               const LoopTruth& truth);

}  // namespace fild
