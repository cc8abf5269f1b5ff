// SPDX-License-Identifier: BSD-3-Clause
#include "checked_image.h"

#include "calibration_mismatch.h"
#include "fild/rawlog/image_file.h"
#include "image_store.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace fild
{
namespace
{
cv::Mat load_stored(const ImageFile& file)
{
    if (auto stored = read_image_file(file.path)) return *stored;
    std::error_code error;  // exists() itself fails at a loop of links
    throw std::runtime_error(described(file) +
                             (std::filesystem::exists(file.path, error)
                                  ? " is no image that can be read to its end; repair it"
                                  : " does not exist; correct the path") +
                             " or leave it out");
}

}  // namespace

std::string described(const ImageFile& file)
{
    // A path is its own origin when the images come from a folder.
    return file.path + (file.origin == file.path ? "" : " (" + file.origin + ")");
}

cv::Mat load_checked(const ImageFile& file)
{
    const auto stored = load_stored(file);
    const auto image = as_grey_or_bgr(stored);
    if (!image)
        throw std::runtime_error(described(file) + " has pixels of " + describe_pixels(stored) +
                                 ", not grey or colour of 8 or 16 bit; convert it");
    return *image;
}

cv::Mat load_checked_depth(const ImageFile& file)
{
    auto depth = load_stored(file);
    if (depth.type() != CV_16UC1)
        throw std::runtime_error(described(file) +
                                 " is no depth image: its pixels are not 16-bit grey; give depth "
                                 "as 16-bit numbers, for example in .png files");
    return depth;
}

void check_calibrated_size(const ImageFile& file, cv::Size size, const CameraModel& camera)
{
    const cv::Size calibrated(camera.width, camera.height);
    if (size != calibrated)
        throw std::runtime_error("the calibration is for " + to_text(calibrated) + " pixels, " +
                                 described(file) + " has " + to_text(size) +
                                 "; correct the calibration or leave it out");
}

void check_same_size(const ImageFile& one,
                     cv::Size size_of_one,
                     const ImageFile& other,
                     cv::Size size_of_other)
{
    if (size_of_one != size_of_other)
        throw std::runtime_error(described(one) + " has " + to_text(size_of_one) + " pixels, " +
                                 described(other) + ", which belongs to it, " +
                                 to_text(size_of_other) + "; both must be of one size");
}

}  // namespace fild
