// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/loop_truth.h"

#include <optional>
#include <vector>

namespace fild
{
/** A frame of a run and what the truth says of it. */
struct JudgedFrame
{
    FrameVerdict verdict;
    bool loop_query = false;  ///< it comes back to an earlier place
    std::optional<Judgement> judgement;  ///< of the candidate, accepted or not; none: there is none
    /** Of a loop query that is not answered() the middle one of its right candidates; none when the
     *  truth knows none, or the frame is not such a query. */
    std::optional<FrameId> true_candidate{};

    /** A loop closure that is right. */
    bool answered() const { return verdict.accepted() && judgement == Judgement::right; }
};

/** Asks the truth about each frame and its candidate. The cost is quadratic in the number of
 *  frames.
 */
std::vector<JudgedFrame> judge_frames(const std::vector<FrameVerdict>& frames,
                                      const LoopTruth& truth);

}  // namespace fild
