// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace fild
{
/** Sums of grey values over rectangles that start at the upper left corner of the image; the sum
 *  over any upright rectangle is then four look-ups (SURF section 3.1).
 *
 *  Entry (x, y), 0 <= x <= width, 0 <= y <= height, is the sum over columns < x and rows < y. Sums
 *  wrap around modulo 2^32, which leaves differences right for every rectangle of less than 8
 * million pixels, however large the image. Const members may run concurrently. */
class IntegralImage
{
 public:
    /** \param grey  8 bit, 1 channel. */
    explicit IntegralImage(const cv::Mat& grey);

    int width() const { return width_; }
    int height() const { return height_; }

    /** The width() + 1 entries of row y, 0 <= y <= height(). */
    const std::uint32_t* row(int y) const
    {
        return first_ + static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_);
    }
    /** Entries from a row to the next. */
    int stride() const { return stride_; }

 private:
    int width_;
    int height_;
    int stride_;
    std::unique_ptr<std::uint32_t[]> sums_;
    std::uint32_t* first_;  ///< of sums_, at the beginning of a cache line
};

}  // namespace fild
