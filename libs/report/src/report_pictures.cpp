// SPDX-License-Identifier: BSD-3-Clause
#include "report_pictures.h"

#include "data_url.h"
#include "fild/core/parallel_for.h"
#include "fild/core/spread.h"
#include "fild/evaluation/evaluation_report.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace fild
{
namespace
{
using Json = nlohmann::ordered_json;

/** QUERY_CANDIDATE_3d.jpg beside the match picture, relative to the folder; empty when there is
 * none. */
std::string match_picture_3d_of(const std::string& folder, const FrameVerdict& frame)
{
    std::filesystem::path picture = match_picture_of(folder, frame);
    if (picture.empty()) return "";
    picture.replace_filename(picture.stem().string() + "_3d.jpg");
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

/** The pictures of the pairs as URLs that hold them, by pair.
 *  \param picture_of  path of a pair's picture, relative to the folder. */
Json urls_of(const std::string& folder,
             const std::vector<const FrameVerdict*>& pairs,
             std::string (*picture_of)(const std::string&, const FrameVerdict&),
             int max_width_px)
{
    std::vector<std::string> urls(pairs.size());
    constexpr int kAllCores = 0;
    parallel_for(kAllCores,
                 pairs.size(),
                 [&](std::size_t i)
                 {
                     const auto path =
                         std::filesystem::path(folder) / picture_of(folder, *pairs[i]);
                     urls[i] = data_url_of_picture(path.string(), max_width_px);
                 });
    Json by_pair = Json::object();
    for (std::size_t i = 0; i < pairs.size(); ++i)
        by_pair[pair_key(*pairs[i])] = std::move(urls[i]);
    return by_pair;
}
}  // namespace

std::vector<const FrameVerdict*> frames_to_show(const std::string& folder,
                                                const std::vector<FrameVerdict>& frames,
                                                const TReportOptions& options,
                                                const std::set<FrameId>& wrong)
{
    std::vector<const FrameVerdict*> shown;
    std::vector<const FrameVerdict*> accepted;
    std::vector<const FrameVerdict*> rejected;
    for (const auto& frame : frames)
    {
        if (!frame.candidate || match_picture_of(folder, frame).empty()) continue;
        const bool is_wrong = frame.accepted() && wrong.count(frame.frame) != 0;
        (is_wrong ? shown : frame.accepted() ? accepted : rejected).push_back(&frame);
    }
    std::stable_sort(accepted.begin(),
                     accepted.end(),
                     [](const auto* a, const auto* b) { return a->support < b->support; });
    std::stable_sort(rejected.begin(),
                     rejected.end(),
                     [](const auto* a, const auto* b) { return a->support > b->support; });
    const auto limit = static_cast<std::size_t>(options.max_pictures);
    shown.resize(std::min(shown.size(), limit));
    const auto room = limit - shown.size();
    // Rejected pairs may have at most half of the room.
    rejected.resize(
        std::min(rejected.size(), std::max(room / 2, room - std::min(room, accepted.size()))));
    shown.insert(shown.end(), rejected.begin(), rejected.end());
    for (const auto i : spread_indices(limit - shown.size(), accepted.size()))
        shown.push_back(accepted[i]);
    return shown;
}

void add_pictures(Json& page,
                  const std::string& folder,
                  const std::vector<const FrameVerdict*>& frames,
                  std::size_t limit,
                  int max_width_px)
{
    std::vector<const FrameVerdict*> with_picture;
    std::vector<const FrameVerdict*> with_3d;
    for (const auto* frame : frames)
    {
        if (!frame->candidate || match_picture_of(folder, *frame).empty()) continue;
        with_picture.push_back(frame);
        if (!match_picture_3d_of(folder, *frame).empty()) with_3d.push_back(frame);
    }
    page["pictures"] = urls_of(folder, with_picture, match_picture_of, max_width_px);
    const auto room = limit - std::min(limit, with_picture.size());
    std::vector<const FrameVerdict*> chosen_3d;
    for (const auto i : spread_indices(room, with_3d.size())) chosen_3d.push_back(with_3d[i]);
    page["pictures_3d"] = urls_of(folder, chosen_3d, match_picture_3d_of, max_width_px);
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
