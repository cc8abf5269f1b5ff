// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/judged_frame.h"

namespace fild
{
namespace
{
std::optional<FrameId> middle_right_candidate(FrameId query, const LoopTruth& truth)
{
    std::vector<FrameId> right;
    for (std::size_t i = 0; i < to_index(query); ++i)
        if (truth.judge(query, FrameId{i}) == Judgement::right) right.push_back(FrameId{i});
    if (right.empty()) return std::nullopt;
    return right[right.size() / 2];
}
}  // namespace

std::vector<JudgedFrame> judge_frames(const std::vector<FrameVerdict>& frames,
                                      const LoopTruth& truth)
{
    std::vector<JudgedFrame> judged;
    judged.reserve(frames.size());
    for (const auto& verdict : frames)
    {
        judged.push_back({verdict, truth.is_loop_query(verdict.frame), std::nullopt});
        auto& frame = judged.back();
        if (verdict.candidate)
            frame.judgement = truth.judge(verdict.frame, verdict.candidate->frame);
        if (frame.loop_query && !frame.answered())
            frame.true_candidate = middle_right_candidate(verdict.frame, truth);
    }
    return judged;
}

}  // namespace fild
