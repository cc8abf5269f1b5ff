// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.h"

#include "fild/core/spread.h"
#include "report_pictures.h"
#include "run_folder.h"

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

Json side_json(const RunFolder& run,
               const std::optional<ReportTruth>& truth,
               const std::vector<std::size_t>& shown,
               const TReportOptions& options)
{
    std::vector<const FrameVerdict*> frames;
    for (const auto i : shown)
        if (i < run.frames.size()) frames.push_back(&run.frames[i]);
    auto json = run_json(run, truth);
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
    return {
        {"runs",
         {side_json(a, first.truth, shown, options), side_json(b, second.truth, shown, options)}}};
}

}  // namespace fild
