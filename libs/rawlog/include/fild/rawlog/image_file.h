// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>

namespace fild
{
/** The pixels of an image file as they are stored: depth and number of channels unchanged, colour
 *  in the order BGR, no turning by EXIF. Nothing when the file is absent, is no image that OpenCV
 *  reads, or ends too early, which OpenCV by itself lets pass for a JPEG. Never throws on a bad
 *  file. Deterministic; may run concurrently. */
std::optional<cv::Mat> read_image_file(const std::string& path);

}  // namespace fild
