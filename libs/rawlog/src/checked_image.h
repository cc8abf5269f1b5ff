// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/rawlog/image_list.h"

#include <opencv2/core/mat.hpp>

#include <string>

namespace fild
{
/** How an error names a file: its path, and where the path was read if that was in a list. */
std::string described(const ImageFile& file);

/** The pixels of a file in 8 bits, grey or BGR, as as_grey_or_bgr() makes them.
 *  \throw std::runtime_error naming the file when it is absent, cannot be read to its end, or has
 *  other pixels. */
cv::Mat load_checked(const ImageFile& file);

/** The 16-bit numbers of a depth file. \throw std::runtime_error as load_checked. */
cv::Mat load_checked_depth(const ImageFile& file);

/** \throw std::runtime_error when an image has not the size its camera is calibrated for. */
void check_calibrated_size(const ImageFile& file, cv::Size size, const CameraModel& camera);

/** \throw std::runtime_error when two images that belong together differ in size. */
void check_same_size(const ImageFile& one,
                     cv::Size size_of_one,
                     const ImageFile& other,
                     cv::Size size_of_other);

}  // namespace fild
