// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/judged_frame.h"

namespace fild
{
std::vector<JudgedFrame> judge_frames(const std::vector<FrameVerdict>& frames,
                                      const LoopTruth& truth)
{
    std::vector<JudgedFrame> judged;
    judged.reserve(frames.size());
    for (const auto& verdict : frames)
    {
        judged.push_back({verdict, truth.is_loop_query(verdict.frame), std::nullopt});
        if (verdict.candidate)
            judged.back().judgement = truth.judge(verdict.frame, verdict.candidate->frame);
    }
    return judged;
}

}  // namespace fild
