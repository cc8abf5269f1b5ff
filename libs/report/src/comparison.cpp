// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.h"

#include "fild/core/spread.h"
#include "page_frames.h"
#include "report_pictures.h"
#include "run_folder.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

/** Frames that the runs have both are the same; one run may have been stopped sooner. */
void require_same_frames(const RunFolder& first, const RunFolder& second)
{
    constexpr double kSameTime = 1e-5;  // seconds
    const auto frames = std::min(first.frames.size(), second.frames.size());
    for (std::size_t i = 0; i < frames; ++i)
        if (std::abs(first.frames[i].timestamp - second.frames[i].timestamp) > kSameTime)
            throw std::runtime_error(first.path + " and " + second.path +
                                     " are not runs of the same frames: frame " +
                                     std::to_string(i) + " has another time");
}

/** Both runs may have a picture of a frame. */
std::size_t pictures_of_a_run(const TReportOptions& options)
{
    return static_cast<std::size_t>(options.max_pictures) / 2;
}

bool has_loop(const RunFolder& run, std::size_t frame)
{
    return frame < run.frames.size() && run.frames[frame].accepted();
}

std::size_t loops_only_in(const RunFolder& run, const RunFolder& other)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < run.frames.size(); ++i)
        if (has_loop(run, i) && !has_loop(other, i)) ++count;
    return count;
}

/** Frames that are a loop closure in one run only, at most `limit`, spread evenly. */
std::vector<std::size_t> differing_frames(const RunFolder& first,
                                          const RunFolder& second,
                                          std::size_t limit)
{
    std::vector<std::size_t> all;
    const auto frames = std::max(first.frames.size(), second.frames.size());
    for (std::size_t i = 0; i < frames; ++i)
        if (has_loop(first, i) != has_loop(second, i)) all.push_back(i);
    std::vector<std::size_t> chosen;
    for (const auto i : spread_indices(limit, all.size())) chosen.push_back(all[i]);
    return chosen;
}

/** Frames of which a page shows pictures, those that the run has. */
std::vector<const FrameVerdict*> verdicts_of(const RunFolder& run,
                                             const std::vector<std::size_t>& shown)
{
    std::vector<const FrameVerdict*> frames;
    for (const auto i : shown)
        if (i < run.frames.size()) frames.push_back(&run.frames[i]);
    return frames;
}

/** The frames of either run's page, which are those of both. */
PageFrames frames_of_both(PageFrames a, const PageFrames& b)
{
    a.resize(std::max(a.size(), b.size()), false);
    for (std::size_t i = 0; i < b.size(); ++i) a[i] = a[i] || b[i];
    return a;
}

Json side_json(const RunFolder& run,
               const std::optional<ReportTruth>& truth,
               const std::vector<const FrameVerdict*>& frames,
               PageFrames page,
               const TReportOptions& options)
{
    page.resize(run.frames.size());
    auto json = run_json(run, truth, page);
    json["folder"] = run.path;
    add_pictures(json, run.path, frames, pictures_of_a_run(options), options.picture_width_px);
    return json;
}
}  // namespace

Json comparison_json(const ComparedRun& first,
                     const ComparedRun& second,
                     const TReportOptions& options)
{
    const auto a = read_run_folder(first.folder);
    const auto b = read_run_folder(second.folder);
    require_same_frames(a, b);
    const auto shown = differing_frames(a, b, pictures_of_a_run(options));
    const auto of_a = verdicts_of(a, shown);
    const auto of_b = verdicts_of(b, shown);
    auto page = frames_of_both(page_frames(a, first.truth), page_frames(b, second.truth));
    add_pairs(page, of_a);
    add_pairs(page, of_b);
    return {{"runs",
             {side_json(a, first.truth, of_a, page, options),
              side_json(b, second.truth, of_b, page, options)}},
            {"only", {loops_only_in(a, b), loops_only_in(b, a)}}};
}

}  // namespace fild
