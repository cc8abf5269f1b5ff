// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/lost_loop.h"

#include "share.h"

#include <algorithm>

namespace fild
{
namespace
{
/** How far a true candidate came that was checked; nothing more is known when it was verified. */
LossStage stage_of_candidate(Rejection rejection)
{
    switch (rejection)
    {
        case Rejection::none:
        case Rejection::not_consistent_yet:
            return LossStage::choice;
        case Rejection::no_model:
        case Rejection::too_few_inliers:
        case Rejection::may_be_chance:
        case Rejection::may_be_look_alike:
            return LossStage::geometry;
        case Rejection::too_few_matches:
            return LossStage::matching;
        default:
            return LossStage::retrieval;
    }
}

LossStage stage_of(const JudgedFrame& frame,
                   const std::vector<ConsideredCandidate>& answers,
                   const LoopTruth& truth)
{
    const auto& verdict = frame.verdict;
    if (is_unusable(verdict.rejection)) return LossStage::frame;
    if (verdict.rejection == Rejection::too_early) return LossStage::too_early;
    auto furthest = LossStage::retrieval;
    for (const auto& answer : answers)
        if (answer.checked &&
            truth.judge(verdict.frame, answer.candidate.frame) == Judgement::right)
            furthest = std::max(furthest, stage_of_candidate(answer.rejection));
    const bool reported_true = frame.judgement == Judgement::right;
    return furthest == LossStage::choice && reported_true ? LossStage::consistency : furthest;
}

bool has_true_answer(FrameId frame,
                     const std::vector<ConsideredCandidate>& answers,
                     const LoopTruth& truth,
                     std::size_t k)
{
    return std::any_of(answers.begin(),
                       answers.end(),
                       [&](const ConsideredCandidate& answer)
                       {
                           return answer.rank > 0 && answer.rank <= k &&
                                  truth.judge(frame, answer.candidate.frame) == Judgement::right;
                       });
}
}  // namespace

std::string to_word(LossStage stage)
{
    switch (stage)
    {
        case LossStage::frame:
            return "frame";
        case LossStage::too_early:
            return "too_early";
        case LossStage::retrieval:
            return "retrieval";
        case LossStage::matching:
            return "matching";
        case LossStage::geometry:
            return "geometry";
        case LossStage::choice:
            return "choice";
        case LossStage::consistency:
            return "consistency";
    }
    return "";
}

std::string meaning_of(LossStage stage)
{
    switch (stage)
    {
        case LossStage::frame:
            return "the frame could not be used";
        case LossStage::too_early:
            return "nothing was older than the delay";
        case LossStage::retrieval:
            return "no true candidate was checked";
        case LossStage::matching:
            return "the true ones had too few matches";
        case LossStage::geometry:
            return "the true ones had no model, too few inliers or too little evidence";
        case LossStage::choice:
            return "a true one was verified, another reported";
        case LossStage::consistency:
            return "a true one was verified, but the frames around it did not confirm it";
    }
    return "";
}

std::vector<LostLoop> lost_loops(const std::vector<JudgedFrame>& frames,
                                 const AnswersOfFrames& answers,
                                 const LoopTruth& truth)
{
    std::vector<LostLoop> lost;
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (frames[i].loop_query && !frames[i].answered())
            lost.push_back({frames[i].verdict.frame, stage_of(frames[i], answers.at(i), truth)});
    return lost;
}

std::optional<double> candidate_recall(const std::vector<JudgedFrame>& frames,
                                       const AnswersOfFrames& answers,
                                       const LoopTruth& truth,
                                       std::size_t k)
{
    std::size_t loop_queries = 0;
    std::size_t retrieved = 0;
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        if (!frames[i].loop_query) continue;
        ++loop_queries;
        if (has_true_answer(frames[i].verdict.frame, answers.at(i), truth, k)) ++retrieved;
    }
    return share(retrieved, loop_queries);
}

}  // namespace fild
