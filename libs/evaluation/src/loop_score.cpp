// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_score.h"

namespace fild
{
namespace
{
std::optional<double> share(std::size_t part, std::size_t whole)
{
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}
}  // namespace

std::optional<double> LoopScore::precision() const
{
    return share(right, right + wrong_loops.size());
}

std::optional<double> LoopScore::recall() const
{
    return share(right, loop_queries);
}

LoopScore score_loops(const std::vector<FrameVerdict>& frames, const LoopTruth& truth)
{
    LoopScore score;
    score.frames = frames.size();
    for (const auto& verdict : frames)
    {
        const bool loop_query = truth.is_loop_query(verdict.frame);
        if (loop_query) ++score.loop_queries;
        if (!verdict.accepted()) continue;
        ++score.accepted;
        const auto judgement = truth.judge(verdict.frame, verdict.candidate->frame);
        if (judgement == Judgement::right) ++score.right;
        if (judgement == Judgement::neither) ++score.neither;
        if (judgement == Judgement::wrong) score.wrong_loops.push_back({verdict, loop_query});
    }
    return score;
}

}  // namespace fild
