// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/judged_frame.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** Two loop queries belong to one stretch when at most so many frames between them are none. */
constexpr std::size_t kMaxStretchGap = 3;

/** A stretch of the way that was travelled before: a longest row of loop queries with gaps of at
 *  most kMaxStretchGap frames. One loop closure in it is enough to straighten a map there. */
struct LoopStretch
{
    FrameId first{};  ///< loop query
    FrameId last{};  ///< loop query
    std::size_t loop_queries = 0;
    std::size_t answered = 0;  ///< of these, with a right loop closure

    bool found() const { return answered > 0; }
};

/** The stretches of a recording, in the order of frames. */
std::vector<LoopStretch> loop_stretches(const std::vector<JudgedFrame>& frames);

/** How many of them are found. */
std::size_t count_found(const std::vector<LoopStretch>& stretches);

/** Segment recall: share of the stretches that are found; none when there is no stretch. */
std::optional<double> segment_recall(const std::vector<LoopStretch>& stretches);

}  // namespace fild
