// SPDX-License-Identifier: BSD-3-Clause
#include "report_pictures.h"

#include "data_url.h"
#include "fild/report/evaluation_report.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

/** QUERY_CANDIDATE_3d.png beside the match picture, relative to the folder; empty when there is
 * none. */
std::string match_picture_3d_of(const std::string& folder, const FrameVerdict& frame)
{
    std::filesystem::path picture = match_picture_of(folder, frame);
    if (picture.empty()) return "";
    picture.replace_filename(picture.stem().string() + "_3d.png");
    std::error_code unreadable_is_absent;
    const bool is_there =
        std::filesystem::exists(std::filesystem::path(folder) / picture, unreadable_is_absent);
    return is_there ? picture.string() : "";
}

std::string pair_key(const FrameVerdict& frame)
{
    return std::to_string(to_index(frame.frame)) + "_" +
           std::to_string(to_index(frame.candidate->frame));
}
}  // namespace

std::vector<std::size_t> spread(std::size_t count, std::size_t size)
{
    std::vector<std::size_t> chosen;
    count = std::min(count, size);
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(count == 1 ? 0 : i * (size - 1) / (count - 1));
    return chosen;
}

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
    const auto limit = static_cast<std::size_t>(options.max_pictures);
    // Rejected pairs may have at most half of the room.
    chosen.resize(
        std::min(chosen.size(), std::max(limit / 2, limit - std::min(limit, accepted.size()))));
    for (const auto i : spread(limit - chosen.size(), accepted.size()))
        chosen.push_back(accepted[i]);
    return chosen;
}

void add_pictures(Json& page,
                  const std::string& folder,
                  const std::vector<const FrameVerdict*>& frames,
                  std::size_t limit,
                  int max_width_px)
{
    const auto url = [&](const std::string& picture) {
        return data_url_of_picture((std::filesystem::path(folder) / picture).string(),
                                   max_width_px);
    };
    page["pictures"] = page["pictures_3d"] = Json::object();
    std::vector<const FrameVerdict*> with_3d;
    for (const auto* frame : frames)
    {
        const auto picture = frame->candidate ? match_picture_of(folder, *frame) : "";
        if (picture.empty()) continue;
        page["pictures"][pair_key(*frame)] = url(picture);
        if (!match_picture_3d_of(folder, *frame).empty()) with_3d.push_back(frame);
    }
    const auto room = limit - std::min(limit, page["pictures"].size());
    for (const auto i : spread(room, with_3d.size()))
        page["pictures_3d"][pair_key(*with_3d[i])] = url(match_picture_3d_of(folder, *with_3d[i]));
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
