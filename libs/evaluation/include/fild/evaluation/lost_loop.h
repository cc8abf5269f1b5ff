// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/judged_frame.h"
#include "fild/evaluation/loop_truth.h"
#include "fild/results/candidates_csv.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** The stage that lost a loop, from the first to the last. */
enum class LossStage
{
    frame,  ///< the frame could not be used: no image, or not of this camera's kind
    too_early,  ///< the index was still empty
    retrieval,  ///< no true candidate was checked
    matching,  ///< the true candidates that were checked had too few matches
    geometry,  ///< they had no model, or too few inliers
    choice,  ///< a true one was verified, but another candidate was reported
    consistency  ///< a true one was verified and reported, but not frames enough in a row
};

/** All stages in order. */
constexpr std::array<LossStage, 7> kLossStages = {LossStage::frame,
                                                  LossStage::too_early,
                                                  LossStage::retrieval,
                                                  LossStage::matching,
                                                  LossStage::geometry,
                                                  LossStage::choice,
                                                  LossStage::consistency};

/** The enumerator's name. */
std::string to_word(LossStage stage);

/** One phrase that says what happened there. */
std::string meaning_of(LossStage stage);

/** A loop query without a right loop closure. */
struct LostLoop
{
    FrameId frame{};
    LossStage stage{};
};

/** The stage that lost each missed loop query, in the order of frames. A candidate is true when the
 *  truth calls it right; when several true ones were checked, the one that came furthest counts.
 *  \param answers  of the same frames. */
std::vector<LostLoop> lost_loops(const std::vector<JudgedFrame>& frames,
                                 const AnswersOfFrames& answers,
                                 const LoopTruth& truth);

/** Share of the loop queries that have a true candidate among the first `k` answers of the index;
 *  none without a loop query. What was verified beside the answers does not count. */
std::optional<double> candidate_recall(const std::vector<JudgedFrame>& frames,
                                       const AnswersOfFrames& answers,
                                       const LoopTruth& truth,
                                       std::size_t k);

}  // namespace fild
