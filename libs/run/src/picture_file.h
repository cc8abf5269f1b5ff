// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>

namespace fild
{
/** Writes a picture in the format of its name's ending; the file appears when it is whole.
 *  \throw std::runtime_error as WholeFile. */
void write_picture(const std::string& path, const cv::Mat& picture);

}  // namespace fild
