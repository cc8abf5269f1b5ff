// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/judged_pair.h"

namespace fild
{
std::vector<JudgedPair> judge_pairs(const AnswersOfFrames& answers, const LoopTruth& truth)
{
    std::vector<JudgedPair> pairs;
    for (std::size_t i = 0; i < answers.size(); ++i)
        for (const auto& considered : answers[i])
            if (considered.odds)
                pairs.push_back(
                    {FrameId{i}, considered, truth.judge(FrameId{i}, considered.candidate.frame)});
    return pairs;
}

}  // namespace fild
