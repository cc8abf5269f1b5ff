// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>

namespace fild
{
/** How a line of text looks. */
struct TextStyle
{
    double height_px = 16;  ///< of a capital letter
    cv::Scalar colour = {50, 45, 40};  ///< BGR
    /** What part of the text stands at the point that is given: 0 its left or upper end, 0.5 its
     *  middle, 1 its right or lower end. */
    cv::Point2d anchor = {0, 1};
    bool has_halo = false;  ///< a white rim, for text on a picture
};

/** Of the letters, without what reaches below their line, pixels. */
cv::Size text_size(const std::string& text, const TextStyle& style);

void draw_text(cv::Mat& picture,
               const std::string& text,
               const cv::Point2d& at,
               const TextStyle& style);

}  // namespace fild
