// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/worst_wrong_pair.h"

namespace fild
{
std::optional<WorstWrongPair> worst_wrong_pair(const std::vector<JudgedFrame>& frames,
                                               const AnswersOfFrames& answers,
                                               const LoopTruth& truth)
{
    std::optional<WorstWrongPair> worst;
    const auto consider = [&](const WorstWrongPair& pair)
    {
        if (!worst || pair.inliers > worst->inliers) worst = pair;
    };
    for (const auto& [verdict, loop_query, judgement] : frames)
        if (judgement == Judgement::wrong)
            consider(
                {verdict.frame, verdict.candidate->frame, verdict.inliers, verdict.accepted()});
    for (std::size_t i = 0; i < answers.size(); ++i)
        for (const auto& answer : answers[i])
            if (answer.checked && (!worst || answer.inliers > worst->inliers) &&
                truth.judge(FrameId{i}, answer.candidate.frame) == Judgement::wrong)
                consider({FrameId{i}, answer.candidate.frame, answer.inliers, false});
    return worst;
}

}  // namespace fild
