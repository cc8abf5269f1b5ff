// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/judged_frame.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** The wrong pair that came nearest to being accepted. */
struct WorstWrongPair
{
    FrameId frame{};
    FrameId candidate{};
    std::size_t inliers = 0;
    double support = 0;  ///< as in FrameVerdict
    bool accepted = false;
};

/** The pair of a frame and the candidate it reports that has the most support of all that the truth
 *  calls wrong, accepted or not; of several the first. None when no candidate is wrong. */
std::optional<WorstWrongPair> worst_wrong_pair(const std::vector<JudgedFrame>& frames);

}  // namespace fild
