// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integral_image.h"

#include <vector>

namespace fild
{
/** Square mask of boxes that stands for second derivatives of a Gaussian (SURF Fig. 2), one pixel
 *  number: the side of a lobe, odd. The mask is three lobes wide; 9x9 stands for sigma = 1.2. */
struct BoxMask
{
    int lobe = 3;

    int size() const { return 3 * lobe; }
    int reach() const { return (3 * lobe - 1) / 2; }  ///< from the centre to the outermost pixel
};

/** The scale s (sigma of the Gaussian, pixels) that a mask of this side stands for. */
constexpr float scale_of_mask(float size)
{
    return size * (1.2F / 9.0F);
}

/** Answers of one mask at every step-th pixel: grid point (column, row) is pixel (column * step,
 *  row * step). Grid points whose mask leaves the image hold 0. */
struct HessianLayer
{
    BoxMask mask;
    int step = 1;
    int columns = 0;
    int rows = 0;
    std::vector<float> determinant;  ///< columns x rows, row-major

    HessianLayer(const IntegralImage& integral, BoxMask box_mask, int sampling_step);

    const float* row(int y) const
    {
        return determinant.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(columns);
    }
};

/** Fills rows [first_row, last_row) of `layer`: det(H) = Dxx Dyy - (0.9 Dxy)^2, Eq. (3), where D
 * are box sums divided by the area of the mask (so that all scales compare) and multiplied by 3.6.
 * That factor only sets the scale of thresholds; see TLocalFeatureOptions::hessian_threshold. Pure
 * but for these rows: bands of rows may be filled in parallel. */
void fill_determinants(const IntegralImage& integral,
                       HessianLayer& layer,
                       int first_row,
                       int last_row);

}  // namespace fild
