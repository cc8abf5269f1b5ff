// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integral_image.h"

namespace fild
{
/** Brightness change at a point: right half minus left half of a square, lower minus upper. */
struct HaarResponse
{
    float dx = 0;
    float dy = 0;
};

/** Haar wavelets of a square window centred at (x, y), pixels, centre of the upper left pixel at
 *  (0, 0), mean change of grey value between its halves (SURF section 4.1, Fig. 9).
 *
 *  Edges may cut pixels: the integral image is interpolated, which is exact for pixels that are
 *  squares of one colour, so the answer changes smoothly with position and side.
 *  \param side  pixels, > 0.
 *  \return 0, 0 for a window that is not wholly inside the image. */
HaarResponse haar_response(const IntegralImage& integral, float x, float y, float side);

}  // namespace fild
