// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/judged_frame.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild::testing
{
/** A frame with a candidate that scores `inliers`, and similarity 0.01 * inliers. */
inline JudgedFrame judged(Judgement judgement,
                          std::size_t inliers,
                          bool loop_query,
                          Rejection rejection = Rejection::too_few_inliers)
{
    JudgedFrame frame;
    frame.verdict.candidate = Candidate{FrameId{0}, 0.01 * static_cast<double>(inliers)};
    frame.verdict.inliers = inliers;
    frame.verdict.rejection = rejection;
    frame.loop_query = loop_query;
    frame.judgement = judgement;
    return frame;
}

/** A frame without a candidate. */
inline JudgedFrame unanswered(bool loop_query)
{
    JudgedFrame frame;
    frame.verdict.rejection = Rejection::no_candidate;
    frame.loop_query = loop_query;
    return frame;
}

/** The frames with ids 0, 1, 2... */
inline std::vector<JudgedFrame> numbered(std::vector<JudgedFrame> frames)
{
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i].verdict.frame = FrameId{i};
    return frames;
}

}  // namespace fild::testing
