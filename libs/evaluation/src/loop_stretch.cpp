// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_stretch.h"

#include "share.h"

#include <algorithm>

namespace fild
{
std::vector<LoopStretch> loop_stretches(const std::vector<JudgedFrame>& frames)
{
    std::vector<LoopStretch> stretches;
    for (const auto& frame : frames)
    {
        if (!frame.loop_query) continue;
        const auto id = frame.verdict.frame;
        if (stretches.empty() ||
            to_index(id) - to_index(stretches.back().last) > kMaxStretchGap + 1)
            stretches.push_back({id, id, 0, 0});
        auto& stretch = stretches.back();
        stretch.last = id;
        ++stretch.loop_queries;
        if (frame.answered()) ++stretch.answered;
    }
    return stretches;
}

std::size_t count_found(const std::vector<LoopStretch>& stretches)
{
    return static_cast<std::size_t>(std::count_if(stretches.begin(),
                                                  stretches.end(),
                                                  [](const LoopStretch& stretch)
                                                  { return stretch.found(); }));
}

std::optional<double> segment_recall(const std::vector<LoopStretch>& stretches)
{
    return share(count_found(stretches), stretches.size());
}

}  // namespace fild
