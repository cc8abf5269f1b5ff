// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/judged_frame.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** An accepted loop closure that the truth contradicts. */
struct WrongLoop
{
    FrameVerdict verdict;
    bool loop_query = false;  ///< the frame has a loop, but this is not it
};

/** Loop closures counted against the truth. accepted = right + wrong_loops + neither. */
struct LoopScore
{
    std::size_t frames = 0;
    std::size_t loop_queries = 0;
    std::size_t accepted = 0;
    std::size_t right = 0;
    std::size_t neither = 0;
    std::vector<WrongLoop> wrong_loops;  ///< in the order of frames

    /** Loop queries without a right answer: rejected, or accepted with another candidate. */
    std::size_t missed() const { return loop_queries - right; }

    /** Share of the loop closures, those that are neither left out, that are right; nothing when
     *  there are none. */
    std::optional<double> precision() const;

    /** Share of the loop queries that are answered rightly; nothing when there are none. */
    std::optional<double> recall() const;
};

/** Counts the loop closures by what the truth said of them. Deterministic. */
LoopScore score_loops(const std::vector<JudgedFrame>& frames);

}  // namespace fild
