// SPDX-License-Identifier: BSD-3-Clause
#include "page_frames.h"

#include "fild/core/spread.h"
#include "fild/core/words.h"

#include <algorithm>
#include <array>

namespace fild
{
namespace
{
struct FrameGroup
{
    const char* what;  ///< one of them
    std::vector<std::size_t> frames;
};

/** What tells most comes first, frames that are neither a loop closure nor missed last. */
using FrameGroups = std::array<FrameGroup, 4>;

FrameGroups groups_of(const RunFolder& run, const std::optional<ReportTruth>& truth)
{
    FrameGroups groups{{{"wrong loop closure", {}},
                        {"missed loop", {}},
                        {truth ? "other loop closure" : "loop closure", {}},
                        {"other frame", {}}}};
    auto& [wrong, missed, loops, others] = groups;
    for (std::size_t i = 0; i < run.frames.size(); ++i)
    {
        const bool is_loop = run.frames[i].accepted();
        const auto* judged = truth ? &truth->evaluation.frames.at(i) : nullptr;
        const bool is_wrong = judged && is_loop && judged->judgement == Judgement::wrong;
        const bool is_missed = judged && !is_loop && judged->loop_query && !judged->answered();
        (is_wrong ? wrong : is_missed ? missed : is_loop ? loops : others).frames.push_back(i);
    }
    return groups;
}

bool is_whole(const PageFrames& page)
{
    return std::find(page.begin(), page.end(), false) == page.end();
}
}  // namespace

PageFrames page_frames(const RunFolder& run, const std::optional<ReportTruth>& truth)
{
    const auto count = run.frames.size();
    if (count <= kMostPageFrames) return PageFrames(count, true);
    PageFrames page(count, false);
    page.front() = page.back() = true;
    const auto groups = groups_of(run, truth);
    std::size_t room = kMostPageFrames;
    std::size_t groups_after = groups.size();
    for (const auto& group : groups)
    {
        --groups_after;
        const auto wanted =
            spread_indices(room - groups_after * kMostPageFrames / 4, group.frames.size());
        for (const auto i : wanted) page[group.frames[i]] = true;
        room -= wanted.size();
    }
    std::vector<const FrameVerdict*> loops;
    for (std::size_t i = 0; i < count; ++i)
        if (page[i] && run.frames[i].accepted()) loops.push_back(&run.frames[i]);
    add_pairs(page, loops);
    return page;
}

void add_pairs(PageFrames& page, const std::vector<const FrameVerdict*>& frames)
{
    for (const auto* frame : frames)
    {
        page.at(to_index(frame->frame)) = true;
        if (frame->candidate) page.at(to_index(frame->candidate->frame)) = true;
    }
}

std::string note_on_frames(const RunFolder& run,
                           const std::optional<ReportTruth>& truth,
                           const PageFrames& page)
{
    if (is_whole(page)) return "";
    std::string parts;
    for (const auto& [what, frames] : groups_of(run, truth))
    {
        if (frames.empty()) continue;
        const auto shown = static_cast<std::size_t>(
            std::count_if(frames.begin(), frames.end(), [&](std::size_t i) { return page[i]; }));
        parts += parts.empty() ? "" : ", ";
        if (shown < frames.size())
            parts += std::to_string(shown) + " of ";
        else if (shown > 1)
            parts += "all ";
        parts += count_of(frames.size(), what);
    }
    return "This page holds " + std::to_string(std::count(page.begin(), page.end(), true)) +
           " of " + count_of(page.size(), "frame") + ": " + parts +
           "; those that are not all there are at even distances along the recording. frames.csv "
           "has "
           "all, and the numbers count all.";
}

}  // namespace fild
