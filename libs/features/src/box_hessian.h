// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integral_image.h"

#include <algorithm>
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

/** Smallest multiple of `step` that is not below `value`, divided by `step`. */
constexpr int ceil_divide(int value, int step)
{
    return (value + step - 1) / step;
}

/** Answers of one mask at every step-th pixel: grid point (column, row) is pixel (column * step,
 *  row * step). Grid points whose mask leaves the image hold 0. */
struct HessianLayer
{
    BoxMask mask;
    int step = 1;
    int columns = 0;
    int rows = 0;  ///< of the whole image
    int first_row = 0;  ///< The layer holds rows from this one on.
    std::vector<float> determinant;  ///< row-major

    /** Holds all rows. */
    HessianLayer(const IntegralImage& integral, BoxMask box_mask, int sampling_step);
    /** Holds those of the rows [first, last) that the image has. */
    HessianLayer(
        const IntegralImage& integral, BoxMask box_mask, int sampling_step, int first, int last);

    const float* row(int y) const { return determinant.data() + index_of_row(y); }
    float* row(int y) { return determinant.data() + index_of_row(y); }

 private:
    std::size_t index_of_row(int y) const
    {
        return static_cast<std::size_t>(y - first_row) * static_cast<std::size_t>(columns);
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

/** Grid points at which a mask fits into `pixels` pixels: [first, last). */
struct FittingRange
{
    int first = 0;
    int last = 0;

    FittingRange(int pixels, const HessianLayer& layer)
        : first(ceil_divide(layer.mask.reach(), layer.step)),
          last(ceil_divide(std::max(0, pixels - layer.mask.reach()), layer.step))
    {
    }
};

/** The rows of the integral image at the edges of a mask's boxes about pixels of row y; the mask
 *  must fit, reach <= y < height - reach. */
struct MaskEdges
{
    const std::uint32_t* xx_top;
    const std::uint32_t* xx_bottom;
    const std::uint32_t* yy_top;
    const std::uint32_t* yy_inner_top;
    const std::uint32_t* yy_inner_bottom;
    const std::uint32_t* yy_bottom;
    const std::uint32_t* xy_top;
    const std::uint32_t* xy_inner_top;
    const std::uint32_t* xy_inner_bottom;
    const std::uint32_t* xy_bottom;

    MaskEdges(const IntegralImage& integral, BoxMask mask, int y);
};

}  // namespace fild
