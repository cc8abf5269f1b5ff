// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_layouts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
std::string to_word(ImageLayout layout)
{
    for (const auto& [word, candidate] : layout_words())
        if (candidate == layout) return word;
    throw std::invalid_argument("no such layout of images");
}

/** An option of the user, and the layouts it goes with. */
struct OptionUse
{
    std::string option;
    bool is_given;
    std::vector<ImageLayout> layouts;
};

void check_goes_with(const OptionUse& use, ImageLayout layout)
{
    const auto& layouts = use.layouts;
    if (!use.is_given || std::find(layouts.begin(), layouts.end(), layout) != layouts.end()) return;
    std::string words;
    for (const auto good : layouts) words += (words.empty() ? "" : ", ") + to_word(good);
    throw std::invalid_argument(use.option + " does not go with --format " + to_word(layout) +
                                ", only with " + words);
}

void check_options_fit(const LayoutRequest& request)
{
    using L = ImageLayout;
    const std::vector<OptionUse> uses{
        {"--list", request.list_path.has_value(), {L::list}},
        {"--timestamps", !request.timestamps.file.empty(), {L::list, L::stereo, L::kitti}},
        {"--rate", request.timestamps.rate_hz.has_value(), {L::list, L::stereo, L::kitti}},
        {"--right", request.right_dir.has_value(), {L::stereo}},
        {"--depth", request.depth_dir.has_value(), {L::list}},
        {"--depth-scale", request.depth_units_per_metre.has_value(), {L::list, L::tum}}};
    for (const auto& use : uses) check_goes_with(use, request.layout);
}

void check_options_complete(const LayoutRequest& request)
{
    const auto layout = request.layout;
    if (layout == ImageLayout::stereo && !request.right_dir)
        throw std::invalid_argument("--format stereo needs --right DIR, the right images");
    const bool with_depth = layout == ImageLayout::tum || request.depth_dir;
    if ((with_depth || layout == ImageLayout::stereo) && !request.calibration_path)
        throw std::invalid_argument(std::string(with_depth ? "depth" : "--format stereo") +
                                    " needs --calib FILE, the calibration of the camera" +
                                    (with_depth ? "" : " and its last line 'baseline METRES'"));
    const auto& units = request.depth_units_per_metre;
    if (units && !with_depth)
        throw std::invalid_argument("--depth-scale says nothing without --depth DIR");
    if (units && !(*units > 0 && std::isfinite(*units)))
        throw std::invalid_argument("--depth-scale must be above 0");
}

Recording read_list(const LayoutRequest& request, const std::optional<Calibration>& calibration)
{
    const auto images = request.list_path ? read_image_list(*request.list_path)
                                          : list_image_folder(request.images_dir);
    if (request.depth_dir)
        return read_images_with_depth(
            images, *request.depth_dir, request.timestamps, calibration.value());
    return mono_recording(stamp_images(images, request.timestamps), calibration);
}

Recording read_layout(const LayoutRequest& request, const std::optional<Calibration>& calibration)
{
    switch (request.layout)
    {
        case ImageLayout::list:
            return read_list(request, calibration);
        case ImageLayout::kitti:
            return read_kitti_layout(request.images_dir, request.timestamps, calibration);
        case ImageLayout::malaga:
            return read_malaga_layout(request.images_dir, calibration);
        case ImageLayout::newcollege:
            return read_newcollege_layout(request.images_dir, calibration);
        case ImageLayout::tum:
            return read_tum_layout(request.images_dir, calibration.value());
        case ImageLayout::stereo:
            return read_stereo_folders(request.images_dir,
                                       request.right_dir.value(),
                                       request.timestamps,
                                       calibration.value());
    }
    throw std::invalid_argument("no such layout of images");
}
}  // namespace

const std::vector<std::pair<std::string, ImageLayout>>& layout_words()
{
    static const std::vector<std::pair<std::string, ImageLayout>> words{
        {"list", ImageLayout::list},
        {"kitti", ImageLayout::kitti},
        {"malaga", ImageLayout::malaga},
        {"newcollege", ImageLayout::newcollege},
        {"tum", ImageLayout::tum},
        {"stereo", ImageLayout::stereo}};
    return words;
}

ImageLayout layout_named(const std::string& word)
{
    for (const auto& [known, layout] : layout_words())
        if (known == word) return layout;
    throw std::invalid_argument("no layout is named '" + word + "'");
}

Recording read_recording(const LayoutRequest& request)
{
    check_options_fit(request);
    check_options_complete(request);
    std::optional<Calibration> calibration;
    if (request.calibration_path) calibration = read_calibration_file(*request.calibration_path);
    auto recording = read_layout(request, calibration);
    if (request.depth_units_per_metre)
        recording.depth_units_per_metre = *request.depth_units_per_metre;
    return recording;
}

}  // namespace fild
