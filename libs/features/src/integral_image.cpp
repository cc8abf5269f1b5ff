// SPDX-License-Identifier: BSD-3-Clause
// Integral image: SURF (CVIU 2008) section 3.1.
#include "integral_image.h"

#include <algorithm>

namespace fild
{
namespace
{
constexpr std::size_t kLineBytes = 64;
constexpr int kEntriesPerLine = kLineBytes / sizeof(std::uint32_t);

/** An odd number of cache lines: entries above one another are then in different parts of the
 *  cache, which would else hold few of them in images that are 1024 or 2048 pixels wide. */
int stride_for(int entries)
{
    return ((entries + kEntriesPerLine - 1) / kEntriesPerLine | 1) * kEntriesPerLine;
}
}  // namespace

IntegralImage::IntegralImage(const cv::Mat& grey)
    : width_(grey.cols), height_(grey.rows), stride_(stride_for(grey.cols + 1))
{
    const auto stride = static_cast<std::size_t>(stride_);
    const auto entries = stride * (static_cast<std::size_t>(height_) + 1);
    // Not std::vector, which would first write zeros to all of it.
    sums_.reset(new std::uint32_t[entries + kEntriesPerLine]);
    void* first = sums_.get();
    std::size_t bytes = (entries + kEntriesPerLine) * sizeof(std::uint32_t);
    first_ = static_cast<std::uint32_t*>(std::align(kLineBytes, 1, first, bytes));
    std::fill_n(first_, stride, 0U);
    for (int y = 0; y < height_; ++y)
    {
        const auto* pixels = grey.ptr<std::uint8_t>(y);
        const auto* above = row(y);
        auto* below = first_ + stride * (static_cast<std::size_t>(y) + 1);
        below[0] = 0;
        std::uint32_t sum_of_row = 0;
        for (int x = 0; x < width_; ++x)
        {
            sum_of_row += pixels[x];
            below[x + 1] = above[x + 1] + sum_of_row;
        }
    }
}

}  // namespace fild
