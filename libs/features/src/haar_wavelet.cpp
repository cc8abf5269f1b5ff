// SPDX-License-Identifier: BSD-3-Clause
// Haar wavelet responses from the integral image: SURF (CVIU 2008) section 4.1.
#include "haar_wavelet.h"

#include <algorithm>

namespace fild
{
namespace
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

/** Rows of the integral image at a height between two entries, as differences from `origin` so that
 *  a float holds them. */
struct InterpolatedRow
{
    const std::uint32_t* upper;
    const std::uint32_t* lower;
    float fraction;
    std::uint32_t origin;

    float entry(int x) const
    {
        const auto above = static_cast<float>(static_cast<std::int32_t>(upper[x] - origin));
        const auto below = static_cast<float>(static_cast<std::int32_t>(lower[x] - origin));
        return above + fraction * (below - above);
    }
    float at(const Between& x) const
    {
        const float left = entry(x.index);
        return left + x.fraction * (entry(x.index + 1) - left);
    }
};
}  // namespace

HaarResponse haar_response(const IntegralImage& integral, float x, float y, float side)
{
    // The integral image counts from the upper left corner of the first pixel, not from its centre.
    const float half = 0.5F * side;
    const float centre_x = x + 0.5F;
    const float centre_y = y + 0.5F;
    if (!(centre_x >= half && centre_x + half <= static_cast<float>(integral.width()) &&
          centre_y >= half && centre_y + half <= static_cast<float>(integral.height())))
        return {};

    const Between left(centre_x - half, integral.width() + 1);
    const Between middle(centre_x, integral.width() + 1);
    const Between right(centre_x + half, integral.width() + 1);
    const Between upper(centre_y - half, integral.height() + 1);
    const Between centre(centre_y, integral.height() + 1);
    const Between lower(centre_y + half, integral.height() + 1);

    const auto origin = integral.row(centre.index)[middle.index];
    const auto row_at = [&](const Between& at)
    {
        return InterpolatedRow{
            integral.row(at.index), integral.row(at.index + 1), at.fraction, origin};
    };
    const auto top = row_at(upper);
    const auto mid = row_at(centre);
    const auto bottom = row_at(lower);
    const float top_left = top.at(left);
    const float top_right = top.at(right);
    const float bottom_left = bottom.at(left);
    const float bottom_right = bottom.at(right);
    const float whole = bottom_right - bottom_left - top_right + top_left;
    const float left_half = bottom.at(middle) - bottom_left - top.at(middle) + top_left;
    const float upper_half = mid.at(right) - mid.at(left) - top_right + top_left;
    const float per_half = 2.0F / (side * side);
    return {(whole - 2.0F * left_half) * per_half, (whole - 2.0F * upper_half) * per_half};
}

}  // namespace fild
