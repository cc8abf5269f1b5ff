// SPDX-License-Identifier: BSD-3-Clause
#include "picture_text.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace fild
{
namespace
{
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kCapitalHeight = 21;  // of the font at scale 1, pixels

double scale_of(const TextStyle& style)
{
    return style.height_px / kCapitalHeight;
}

int stroke_of(const TextStyle& style)
{
    return std::max(1, cvRound(style.height_px / 10));
}
}  // namespace

cv::Size text_size(const std::string& text, const TextStyle& style)
{
    int below = 0;
    return {cv::getTextSize(text, kFont, scale_of(style), stroke_of(style), &below).width,
            cvRound(style.height_px)};
}

void draw_text(cv::Mat& picture,
               const std::string& text,
               const cv::Point2d& at,
               const TextStyle& style)
{
    const auto size = text_size(text, style);
    const cv::Point origin(cvRound(at.x - style.anchor.x * size.width),
                           cvRound(at.y + (1 - style.anchor.y) * size.height));
    const int stroke = stroke_of(style);
    const auto put = [&](const cv::Scalar& colour, int thickness)
    { cv::putText(picture, text, origin, kFont, scale_of(style), colour, thickness, cv::LINE_AA); };
    if (style.has_halo) put(cv::Scalar::all(255), stroke + 2 * std::max(2, stroke));
    put(style.colour, stroke);
}

}  // namespace fild
