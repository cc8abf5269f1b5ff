// SPDX-License-Identifier: BSD-3-Clause
#include "report_pictures.h"

#include "data_url.h"
#include "fild/core/parallel_for.h"
#include "fild/core/spread.h"
#include "fild/report/evaluation_report.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

/** QUERY_CANDIDATE_3d.jpg beside QUERY_CANDIDATE.jpg. */
std::filesystem::path variant_3d(const std::filesystem::path& picture)
{
    return picture.parent_path() / (picture.stem().string() + "_3d.jpg");
}

bool has_pictures_3d(const std::string& folder)
{
    const std::filesystem::path matches = std::filesystem::path(folder) / "matches";
    if (!std::filesystem::exists(matches)) return false;
    const std::filesystem::directory_iterator entries(matches);
    return std::any_of(begin(entries),
                       end(entries),
                       [](const auto& entry)
                       {
                           const auto stem = entry.path().stem().string();
                           return stem.size() > 3 && stem.compare(stem.size() - 3, 3, "_3d") == 0;
                       });
}
}  // namespace

std::vector<const FrameVerdict*> frames_to_show(const std::string& folder,
                                                const std::vector<FrameVerdict>& frames,
                                                const TReportOptions& options)
{
    std::vector<const FrameVerdict*> accepted;
    std::vector<const FrameVerdict*> chosen;
    for (const auto& frame : frames)
        if (frame.candidate && !match_picture_of(folder, frame).empty())
            (frame.accepted() ? accepted : chosen).push_back(&frame);
    std::stable_sort(accepted.begin(),
                     accepted.end(),
                     [](const auto* a, const auto* b) { return a->support < b->support; });
    std::stable_sort(chosen.begin(),
                     chosen.end(),
                     [](const auto* a, const auto* b) { return a->support > b->support; });
    const auto limit =
        static_cast<std::size_t>(options.max_pictures) / (has_pictures_3d(folder) ? 2 : 1);
    // Rejected pairs may have at most half of the room.
    chosen.resize(
        std::min(chosen.size(), std::max(limit / 2, limit - std::min(limit, accepted.size()))));
    for (const auto i : spread_indices(limit - chosen.size(), accepted.size()))
        chosen.push_back(accepted[i]);
    return chosen;
}

Json pictures_json(const std::string& folder,
                   const std::vector<const FrameVerdict*>& frames,
                   int max_width_px)
{
    std::vector<std::filesystem::path> paths;
    for (const auto* frame : frames)
        if (const auto picture = frame->candidate ? match_picture_of(folder, *frame) : "";
            !picture.empty())
        {
            paths.push_back(std::filesystem::path(folder) / picture);
            if (const auto path_3d = variant_3d(paths.back()); std::filesystem::exists(path_3d))
                paths.push_back(path_3d);
        }
    std::vector<std::string> urls(paths.size());
    constexpr int kAllCores = 0;
    parallel_for(kAllCores,
                 paths.size(),
                 [&](std::size_t i)
                 { urls[i] = data_url_of_picture(paths[i].string(), max_width_px); });
    Json pictures = Json::object();
    for (std::size_t i = 0; i < paths.size(); ++i)
        pictures[paths[i].stem().string()] = std::move(urls[i]);
    return pictures;
}

Json map_pictures_json(const std::string& folder)
{
    Json json = Json::object();
    for (const auto& [name, title] : {std::pair{"map_top.png", "from above"},
                                      std::pair{"map_perspective.png", "in perspective"}})
        if (std::filesystem::exists(folder + "/" + name))
            json[title] = data_url_of_png(folder + "/" + name);
    return json;
}

}  // namespace fild
