// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/worst_wrong_pair.h"

namespace fild
{
std::optional<WorstWrongPair> worst_wrong_pair(const std::vector<JudgedFrame>& frames)
{
    std::optional<WorstWrongPair> worst;
    for (const auto& frame : frames)
    {
        const auto& verdict = frame.verdict;
        if (frame.judgement == Judgement::wrong && (!worst || verdict.support > worst->support))
            worst = WorstWrongPair{verdict.frame,
                                   verdict.candidate->frame,
                                   verdict.inliers,
                                   verdict.support,
                                   verdict.accepted()};
    }
    return worst;
}

}  // namespace fild
