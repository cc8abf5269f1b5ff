// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/render_options.h"

#include "fild/core/spread.h"

#include <algorithm>
#include <numeric>

namespace fild
{
void TRenderOptions::describe(OptionVisitor& visitor)
{
    visitor.flag("enabled", enabled);
    visitor.integer("max_match_pictures", max_match_pictures, 0, 1000000);
    visitor.choice<PictureChoice>("match_picture_choice",
                                  match_picture_choice,
                                  {{"spread", PictureChoice::spread},
                                   {"weakest", PictureChoice::weakest},
                                   {"strongest", PictureChoice::strongest},
                                   {"first", PictureChoice::first}});
    visitor.integer("match_picture_width_px", match_picture_width_px, 320, 8000);
    visitor.integer("max_match_lines", max_match_lines, 0, 100000);
    visitor.flag("draw_rejected_matches", draw_rejected_matches);
    visitor.flag("match_pictures_3d", match_pictures_3d);
    visitor.flag("write_map_pictures", write_map_pictures);
    visitor.integer("map_picture_width_px", map_picture_width_px, 640, 4000);
    visitor.integer("map_picture_height_px", map_picture_height_px, 400, 4000);
    visitor.choice<LoopColour>("loop_colour",
                               loop_colour,
                               {{"inliers", LoopColour::inliers}, {"weight", LoopColour::weight}});
    visitor.integer("max_rejected_pairs", max_rejected_pairs, 0, 1000000);
    visitor.integer("max_map_cameras", max_map_cameras, 0, 1000);
    visitor.flag("camera_images", camera_images);
}

std::vector<std::size_t> choose_match_pictures(const std::vector<FrameVerdict>& loops,
                                               const TRenderOptions& options)
{
    std::vector<std::size_t> indices(loops.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    const auto limit =
        options.enabled ? static_cast<std::size_t>(options.max_match_pictures) : std::size_t{0};
    if (loops.size() <= limit) return indices;
    if (limit == 0) return {};
    if (options.match_picture_choice == PictureChoice::spread)
        return spread_indices(limit, loops.size());
    const auto inliers = [&](std::size_t i) { return loops[i].inliers; };
    if (options.match_picture_choice == PictureChoice::weakest)
        std::stable_sort(indices.begin(),
                         indices.end(),
                         [&](auto a, auto b) { return inliers(a) < inliers(b); });
    if (options.match_picture_choice == PictureChoice::strongest)
        std::stable_sort(indices.begin(),
                         indices.end(),
                         [&](auto a, auto b) { return inliers(a) > inliers(b); });
    indices.resize(limit);
    std::sort(indices.begin(), indices.end());
    return indices;
}

}  // namespace fild
