// SPDX-License-Identifier: BSD-3-Clause
// Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems" (IROS 2012).
#include "fild/core/parse_number.h"
#include "fild/rawlog/image_layouts.h"
#include "fild/rawlog/robot_path_file.h"
#include "folder_entries.h"
#include "image_pairs.h"
#include "text_lines.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <tuple>

namespace fild
{
namespace
{
namespace fs = std::filesystem;

constexpr double kMaxDifferenceSeconds = 0.02;  // as the benchmark's own tools have it

std::string file_in(const std::string& folder, const std::string& name)
{
    auto path = (fs::path(folder) / name).string();
    if (!fs::exists(path))
        throw std::runtime_error("no " + name + " in " + folder + example_in(folder) +
                                 "; name the folder of a TUM RGB-D sequence, with rgb.txt, "
                                 "depth.txt, rgb/ and depth/");
    return path;
}

/** `seconds path` a line, paths relative to the folder of the list; times grow. */
std::vector<StampedImage> read_stamped_list(const std::string& path)
{
    std::vector<ListedImage> images;
    for (const auto& line : read_text_lines(path))
    {
        const auto end_of_time = line.text.find_first_of(" \t");
        const auto seconds = parse_number<double>(line.text.substr(0, end_of_time));
        if (!seconds || end_of_time == std::string::npos)
            throw std::runtime_error(line.origin + ": '" + line.text +
                                     "' is not of the form 'SECONDS IMAGE'");
        const auto image = fs::path(path).parent_path() / trim(line.text.substr(end_of_time));
        images.push_back({{image.string(), line.origin}, seconds});
    }
    if (images.empty())
        throw std::runtime_error("no image in " + path + "; write 'SECONDS IMAGE' a line");
    return stamp_images(images, {});
}

/** Two images that may belong together. */
struct PossiblePair
{
    double difference_seconds;
    std::size_t colour;
    std::size_t depth;
};

/** All pairs that are near enough in time, the nearest first. */
std::vector<PossiblePair> possible_pairs(const std::vector<StampedImage>& colour,
                                         const std::vector<StampedImage>& depth)
{
    std::vector<PossiblePair> pairs;
    std::size_t first = 0;  // depth images before it are too old for this colour image and the next
    for (std::size_t c = 0; c < colour.size(); ++c)
    {
        const double time = colour[c].seconds;
        while (first < depth.size() && depth[first].seconds <= time - kMaxDifferenceSeconds)
            ++first;
        for (auto d = first; d < depth.size() && depth[d].seconds < time + kMaxDifferenceSeconds;
             ++d)
            pairs.push_back({std::abs(depth[d].seconds - time), c, d});
    }
    std::sort(pairs.begin(),
              pairs.end(),
              [](const PossiblePair& a, const PossiblePair& b)
              {
                  return std::tie(a.difference_seconds, a.colour, a.depth) <
                         std::tie(b.difference_seconds, b.colour, b.depth);
              });
    return pairs;
}

/** For each colour image the depth image that is its own. */
std::vector<std::optional<std::size_t>> associate(const std::vector<StampedImage>& colour,
                                                  const std::vector<StampedImage>& depth)
{
    std::vector<std::optional<std::size_t>> depth_of(colour.size());
    std::vector<bool> taken(depth.size(), false);
    for (const auto& pair : possible_pairs(colour, depth))
    {
        if (depth_of[pair.colour] || taken[pair.depth]) continue;
        depth_of[pair.colour] = pair.depth;
        taken[pair.depth] = true;
    }
    return depth_of;
}

void note_left_out(std::size_t colour, std::size_t depth, Recording& recording)
{
    const std::string within = " within 0.02 s";
    const auto frames = recording.frames.size();
    if (colour > frames)
        recording.left_out.push_back(
            count_without(colour - frames, "colour image", "depth image" + within));
    if (depth > frames)
        recording.left_out.push_back(
            count_without(depth - frames, "depth image", "colour image" + within));
}
}  // namespace

Recording read_tum_layout(const std::string& folder, const Calibration& calibration)
{
    if (!fs::is_directory(folder))
        throw std::runtime_error("no such folder: '" + folder + "'; check the path");
    const auto colour = read_stamped_list(file_in(folder, "rgb.txt"));
    const auto depth = read_stamped_list(file_in(folder, "depth.txt"));
    Recording recording;
    recording.calibration = calibration;
    recording.depth_units_per_metre = 5000;
    const auto depth_of = associate(colour, depth);
    for (std::size_t i = 0; i < colour.size(); ++i)
        if (depth_of[i]) recording.frames.push_back({colour[i], std::nullopt, depth[*depth_of[i]]});
    if (recording.frames.empty())
        throw std::runtime_error("no image of " + folder + "/rgb.txt is within 0.02 s of one of " +
                                 "depth.txt; check that both are of the same recording");
    note_left_out(colour.size(), depth.size(), recording);
    const auto truth = fs::path(folder) / "groundtruth.txt";
    if (fs::exists(truth)) recording.robot_path = read_camera_path(truth.string());
    return recording;
}

}  // namespace fild
