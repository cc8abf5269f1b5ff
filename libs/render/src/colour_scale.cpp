// SPDX-License-Identifier: BSD-3-Clause
#include "colour_scale.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace fild
{
namespace
{
/** All 256 colours of viridis, in one row. */
cv::Mat viridis()
{
    cv::Mat_<unsigned char> levels(1, 256);
    for (int i = 0; i < levels.cols; ++i) levels(i) = static_cast<unsigned char>(i);
    cv::Mat colours;
    cv::applyColorMap(levels, colours, cv::COLORMAP_VIRIDIS);
    return colours;
}
}  // namespace

cv::Scalar colour_on_scale(double share)
{
    static const cv::Mat_<cv::Vec3b> colours = viridis();
    constexpr double kFirst = 0.12;
    constexpr double kLast = 0.93;
    const double place = kFirst + (kLast - kFirst) * std::clamp(share, 0.0, 1.0);
    return {colours(cvRound(255 * place))};
}

}  // namespace fild
