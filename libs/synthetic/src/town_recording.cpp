// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/town_recording.h"

#include "fild/core/whole_file.h"
#include "fild/synthetic/birds_eye.h"
#include "fild/synthetic/town.h"

#include <opencv2/imgcodecs.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace fild
{
namespace
{
/** Draws in a town of its own, which is painted when the first view is drawn. */
DrawView view_of_town(const TTownOptions& options, std::shared_ptr<std::optional<Town>> town)
{
    return [options, town = std::move(town)](
               const auto& camera, const auto& map_from_camera, const auto& conditions)
    {
        if (!*town) town->emplace(options);
        return (*town)->draw(camera, map_from_camera, conditions);
    };
}

void write_birds_eye(WholeFile& file, const TSyntheticOptions& options, Town& town)
{
    const auto seed = static_cast<std::uint64_t>(options.town.seed);
    const auto route = plan_route(options.route, town.grid(), seed);
    std::vector<uchar> png;
    cv::imencode(".png", draw_birds_eye(town, route_lines(route), {}), png);
    file.stream().write(reinterpret_cast<const char*>(png.data()),
                        static_cast<std::streamsize>(png.size()));
    file.commit();
}
}  // namespace

SyntheticSummary write_town_recording(const TownRequest& request, const OnFrame& on_frame)
{
    std::optional<WholeFile> birds_eye;  // opened now: a wrong path is told at once
    if (!request.birds_eye_path.empty())
    {
        refuse_existing(request.birds_eye_path);
        remove_unfinished_of(request.birds_eye_path);
        birds_eye.emplace(request.birds_eye_path);
    }
    const auto& options = request.recording.options;
    const auto town = std::make_shared<std::optional<Town>>();
    const auto of_a_thread = [&]
    { return view_of_town(options.town, std::make_shared<std::optional<Town>>()); };
    auto made = write_synthetic_recording(request.recording,
                                          options.town.street_grid(),
                                          view_of_town(options.town, town),
                                          on_frame,
                                          {request.threads - 1, of_a_thread});
    if (!birds_eye) return made;
    write_birds_eye(*birds_eye, options, town->value());
    made.paths.push_back(request.birds_eye_path);
    return made;
}

}  // namespace fild
