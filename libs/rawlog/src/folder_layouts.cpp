// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/image_layouts.h"
#include "image_pairs.h"

#include <filesystem>

namespace fild
{
namespace
{
/** The folder of images that were listed by list_image_folder(), or that it was a list. */
std::string place_of(const std::vector<ListedImage>& images)
{
    if (images.empty() || images[0].origin != images[0].path) return "the list";
    return std::filesystem::path(images[0].path).parent_path().string();
}
}  // namespace

Recording read_stereo_folders(const std::string& left_dir,
                              const std::string& right_dir,
                              const TimestampSource& timestamps,
                              const Calibration& calibration)
{
    check_stereo_calibration(calibration, "give the left folder alone, without --format stereo");
    const auto left = list_image_folder(left_dir);
    const auto right = list_image_folder(right_dir);
    check_equal_counts(left.size(), left_dir, right.size(), right_dir);
    auto recording = mono_recording(stamp_images(left, timestamps), calibration);
    for (std::size_t i = 0; i < right.size(); ++i) recording.frames[i].right = right[i];
    return recording;
}

Recording read_images_with_depth(const std::vector<ListedImage>& images,
                                 const std::string& depth_dir,
                                 const TimestampSource& timestamps,
                                 const Calibration& calibration)
{
    const auto depth = list_image_folder(depth_dir);
    check_equal_counts(images.size(), place_of(images), depth.size(), depth_dir);
    auto recording = mono_recording(stamp_images(images, timestamps), calibration);
    for (std::size_t i = 0; i < depth.size(); ++i) recording.frames[i].depth = depth[i];
    return recording;
}

}  // namespace fild
