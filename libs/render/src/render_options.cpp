// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/render_options.h"

#include <algorithm>
#include <numeric>

namespace fild
{
namespace
{
/** `count` of the indices below `size`, at even distances, the first and the last among them. */
std::vector<std::size_t> spread(std::size_t count, std::size_t size)
{
    if (count == 1) return {size / 2};
    std::vector<std::size_t> chosen(count);
    for (std::size_t i = 0; i < count; ++i) chosen[i] = i * (size - 1) / (count - 1);
    return chosen;
}
}  // namespace

void TRenderOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("max_match_pictures", max_match_pictures, 0, 1000000);
    visitor.choice<PictureChoice>("match_picture_choice",
                                  match_picture_choice,
                                  {{"spread", PictureChoice::spread},
                                   {"weakest", PictureChoice::weakest},
                                   {"strongest", PictureChoice::strongest},
                                   {"first", PictureChoice::first}});
}

std::vector<std::size_t> choose_match_pictures(const std::vector<FrameVerdict>& loops,
                                               const TRenderOptions& options)
{
    std::vector<std::size_t> indices(loops.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    const auto limit = static_cast<std::size_t>(options.max_match_pictures);
    if (loops.size() <= limit) return indices;
    if (limit == 0) return {};
    if (options.match_picture_choice == PictureChoice::spread) return spread(limit, loops.size());
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
