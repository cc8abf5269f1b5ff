// SPDX-License-Identifier: BSD-3-Clause
// Integral image: SURF (CVIU 2008) section 3.1.
#include "integral_image.h"

namespace fild
{
IntegralImage::IntegralImage(const cv::Mat& grey) : width_(grey.cols), height_(grey.rows)
{
    const auto stride = static_cast<std::size_t>(width_) + 1;
    sums_.assign(stride * (static_cast<std::size_t>(height_) + 1), 0);
    for (int y = 0; y < height_; ++y)
    {
        const auto* pixels = grey.ptr<std::uint8_t>(y);
        const auto* above = row(y);
        auto* below = sums_.data() + stride * (static_cast<std::size_t>(y) + 1);
        std::uint32_t sum_of_row = 0;
        for (int x = 0; x < width_; ++x)
        {
            sum_of_row += pixels[x];
            below[x + 1] = above[x + 1] + sum_of_row;
        }
    }
}

}  // namespace fild
