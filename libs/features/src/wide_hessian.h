// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "box_hessian.h"
#include "lanes.h"

#include <algorithm>
#include <vector>

namespace fild
{
/** Determinants of one mask along rows of pixels, kCount pixels at a time: the sums of MaskRow,
 *  box_hessian.cpp. A row's last vector overlaps the one before. */
template <int kCount>
class WideMaskRow
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;
    using Sums = typename L::Sums;

 public:
    FILD_IN_LANES WideMaskRow(const IntegralImage& integral, BoxMask mask)
        : integral_(integral),
          mask_(mask),
          entries_(integral.width() + 1),
          xx_(static_cast<std::size_t>(entries_)),
          yy_(xx_.size()),
          xy_(xx_.size())
    {
    }

    FILD_IN_LANES void move_to(int y)
    {
        const MaskEdges row(integral_, mask_, y);
        for (int next = 0; next < entries_; next += kCount)
        {
            const int x = std::min(next, entries_ - kCount);
            L::store(at(row.xx_bottom, x) - at(row.xx_top, x), xx_.data() + x);
            L::store(at(row.yy_bottom, x) - at(row.yy_top, x) -
                         3 * (at(row.yy_inner_bottom, x) - at(row.yy_inner_top, x)),
                     yy_.data() + x);
            L::store(at(row.xy_inner_top, x) - at(row.xy_top, x) -
                         (at(row.xy_bottom, x) - at(row.xy_inner_bottom, x)),
                     xy_.data() + x);
        }
    }

    /** Of pixels [first, last) of this row, to out[first]...; at least kCount of them. */
    FILD_IN_LANES void determinants(int first, int last, float* out) const
    {
        const float weight = 3.6F / static_cast<float>(mask_.size() * mask_.size());
        for (int next = first; next < last; next += kCount)
        {
            const int x = std::min(next, last - kCount);
            L::store(determinant(x, weight), out + x);
        }
    }

 private:
    FILD_IN_LANES static Sums at(const std::uint32_t* row, int x)
    {
        return L::template load<Sums>(row + x);
    }

    FILD_IN_LANES Floats determinant(int x, float weight) const
    {
        const int lobe = mask_.lobe;
        const int reach = mask_.reach();
        const int half = (lobe - 1) / 2;
        const auto* xx = xx_.data();
        const auto* yy = yy_.data();
        const auto* xy = xy_.data();
        const Sums sum_xx = at(xx, x + reach + 1) - at(xx, x - reach) -
                            3 * (at(xx, x + half + 1) - at(xx, x - half));
        const Sums sum_yy = at(yy, x + lobe) - at(yy, x + 1 - lobe);
        const Sums sum_xy = at(xy, x) - at(xy, x - lobe) - (at(xy, x + lobe + 1) - at(xy, x + 1));
        const Floats dxx = L::to_floats(sum_xx) * weight;
        const Floats dyy = L::to_floats(sum_yy) * weight;
        const Floats dxy = L::to_floats(sum_xy) * weight;
        return dxx * dyy - 0.81F * dxy * dxy;
    }

    const IntegralImage& integral_;
    BoxMask mask_;
    int entries_;
    std::vector<std::uint32_t> xx_;
    std::vector<std::uint32_t> yy_;
    std::vector<std::uint32_t> xy_;
};

/** fill_determinants(), box_hessian.h, to the same bits. */
template <int kCount>
FILD_IN_LANES void fill_determinants_in_lanes(const IntegralImage& integral,
                                              HessianLayer& layer,
                                              int first_row,
                                              int last_row)
{
    const FittingRange fitting_rows(integral.height(), layer);
    const FittingRange fitting_columns(integral.width(), layer);
    const int first_x = fitting_columns.first * layer.step;
    const int last_x = (fitting_columns.last - 1) * layer.step + 1;
    if (last_x - first_x < kCount) return fill_determinants(integral, layer, first_row, last_row);

    WideMaskRow<kCount> sums(integral, layer.mask);
    std::vector<float> of_pixels(static_cast<std::size_t>(last_x));
    for (int r = std::max(first_row, fitting_rows.first); r < std::min(last_row, fitting_rows.last);
         ++r)
    {
        sums.move_to(r * layer.step);
        auto* out = layer.row(r);
        if (layer.step == 1)
        {
            sums.determinants(first_x, last_x, out);
            continue;
        }
        sums.determinants(first_x, last_x, of_pixels.data());
        for (int c = fitting_columns.first; c < fitting_columns.last; ++c)
            out[c] = of_pixels[static_cast<std::size_t>(c) * static_cast<std::size_t>(layer.step)];
    }
}

}  // namespace fild
