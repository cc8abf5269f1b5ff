// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/rawlog_reader.h"

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>

namespace fild
{
/** The pixels of an image file as they are stored: depth and number of channels unchanged, colour
 *  in the order BGR, no turning by EXIF. Nothing when the file is absent, is no image that OpenCV
 *  reads, ends too early, which OpenCV by itself lets pass for a JPEG, or is too large. Never
 *  throws on a bad file. Deterministic; may run concurrently.
 *  \param max_megabytes  that the file may have, and for JPEG and PNG the pixels by their header,
 *  which OpenCV believes and makes room for (2^20 bytes, > 0). */
std::optional<cv::Mat> read_image_file(const std::string& path,
                                       int max_megabytes = kDefaultMaxEntryMegabytes);

}  // namespace fild
