// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integral_image.h"

#include <algorithm>

namespace fild
{
/** A coordinate of the integral image between two of its entries. */
struct Between
{
    int index = 0;
    float fraction = 0;

    /** \param position  in [0, entries - 1]; entries >= 2. */
    Between(float position, int entries)
        : index(std::min(static_cast<int>(position), entries - 2)),
          fraction(position - static_cast<float>(index))
    {
    }
};

inline float interpolate(float a, float b, float fraction)
{
    return a + fraction * (b - a);
}

/** The integral image of a window alone, which starts at its upper left entry: a float holds its
 *  sums without rounding up to 256x256 pixels. */
class WindowSums
{
 public:
    WindowSums(const IntegralImage& integral, const Between& left, const Between& top)
        : integral_(integral), left_(left.index), top_(integral.row(top.index))
    {
    }

    float at(const Between& x, const Between& y) const
    {
        return interpolate(between_rows(x.index, y), between_rows(x.index + 1, y), x.fraction);
    }

 private:
    float entry(int x, const std::uint32_t* row) const
    {
        const auto sum = row[x] - row[left_] - (top_[x] - top_[left_]);
        return static_cast<float>(static_cast<std::int32_t>(sum));
    }
    float between_rows(int x, const Between& y) const
    {
        return interpolate(
            entry(x, integral_.row(y.index)), entry(x, integral_.row(y.index + 1)), y.fraction);
    }

    const IntegralImage& integral_;
    int left_;
    const std::uint32_t* top_;
};

}  // namespace fild
