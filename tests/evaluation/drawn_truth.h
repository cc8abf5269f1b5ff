// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

#include <cstddef>
#include <vector>

namespace fild::testing
{
/** `count` frames, a second apart from time 0, none accepted. */
inline std::vector<FrameVerdict> frames_at_one_hertz(std::size_t count)
{
    std::vector<FrameVerdict> frames(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        frames[i].frame = FrameId{i};
        frames[i].timestamp = static_cast<double>(i);
        frames[i].rejection = Rejection::too_few_matches;
    }
    return frames;
}

/** Makes `query` a loop closure with `candidate`. */
inline void accept(std::vector<FrameVerdict>& frames, std::size_t query, std::size_t candidate)
{
    frames[query].candidate = Candidate{FrameId{candidate}, 0.9};
    frames[query].rejection = Rejection::none;
}

}  // namespace fild::testing
