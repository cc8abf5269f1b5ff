// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_score.h"

#include "share.h"

namespace fild
{
std::optional<double> LoopScore::precision() const
{
    return share(right, right + wrong_loops.size());
}

std::optional<double> LoopScore::recall() const
{
    return share(right, loop_queries);
}

LoopScore score_loops(const std::vector<JudgedFrame>& frames)
{
    LoopScore score;
    score.frames = frames.size();
    for (const auto& frame : frames)
    {
        if (frame.loop_query) ++score.loop_queries;
        if (!frame.verdict.accepted()) continue;
        ++score.accepted;
        if (frame.judgement == Judgement::right) ++score.right;
        if (frame.judgement == Judgement::neither) ++score.neither;
        if (frame.judgement == Judgement::wrong)
            score.wrong_loops.push_back({frame.verdict, frame.loop_query});
    }
    return score;
}

}  // namespace fild
