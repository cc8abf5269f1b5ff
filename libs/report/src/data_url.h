// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace fild
{
/** The file as it is, as an URL that holds its content. \throw std::runtime_error naming it. */
std::string data_url_of_png(const std::string& path);

/** The picture as JPEG, at most so wide. \throw std::runtime_error naming it. */
std::string data_url_of_picture(const std::string& path, int max_width_px);

}  // namespace fild
