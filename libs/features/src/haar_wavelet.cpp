// SPDX-License-Identifier: BSD-3-Clause
// Haar wavelet responses from the integral image: SURF (CVIU 2008) section 4.1.
#include "haar_wavelet.h"

#include "window_sums.h"

namespace fild
{
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
    const Between top(centre_y - half, integral.height() + 1);
    const Between centre(centre_y, integral.height() + 1);
    const Between bottom(centre_y + half, integral.height() + 1);

    const WindowSums sums(integral, left, top);
    const float top_left = sums.at(left, top);
    const float top_right = sums.at(right, top);
    const float bottom_left = sums.at(left, bottom);
    const float bottom_right = sums.at(right, bottom);
    const float whole = bottom_right - bottom_left - top_right + top_left;
    const float left_half = sums.at(middle, bottom) - bottom_left - sums.at(middle, top) + top_left;
    const float upper_half = sums.at(right, centre) - sums.at(left, centre) - top_right + top_left;
    const float per_half = 2.0F / (side * side);
    return {(whole - 2.0F * left_half) * per_half, (whole - 2.0F * upper_half) * per_half};
}

}  // namespace fild
