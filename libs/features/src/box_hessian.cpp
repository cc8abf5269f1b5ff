// SPDX-License-Identifier: BSD-3-Clause
// Hessian matrix from box filters: SURF (CVIU 2008) section 3.2, Eq. (3).
#include "box_hessian.h"

#include <algorithm>

namespace fild
{
namespace
{
struct SecondDerivatives
{
    std::int32_t xx = 0;
    std::int32_t yy = 0;
    std::int32_t xy = 0;
};

/** Box sums of one mask along one row of pixels. The boxes of a mask share their upper and lower
 *  edges, so their part in y is done once for all x; each derivative is then a few differences. */
class MaskRow
{
 public:
    MaskRow(const IntegralImage& integral, BoxMask mask)
        : integral_(integral),
          mask_(mask),
          xx_(static_cast<std::size_t>(integral.width()) + 1),
          yy_(xx_.size()),
          xy_(xx_.size())
    {
    }

    /** Moves to row y; the mask must fit, reach <= y < height - reach. */
    void move_to(int y)
    {
        const int lobe = mask_.lobe;
        const int reach = mask_.reach();
        const int half = (lobe - 1) / 2;
        const auto* xx_top = integral_.row(y - lobe + 1);
        const auto* xx_bottom = integral_.row(y + lobe);
        const auto* yy_top = integral_.row(y - reach);
        const auto* yy_inner_top = integral_.row(y - half);
        const auto* yy_inner_bottom = integral_.row(y + half + 1);
        const auto* yy_bottom = integral_.row(y + reach + 1);
        const auto* xy_top = integral_.row(y - lobe);
        const auto* xy_inner_top = integral_.row(y);
        const auto* xy_inner_bottom = integral_.row(y + 1);
        const auto* xy_bottom = integral_.row(y + lobe + 1);
        for (std::size_t x = 0; x < xx_.size(); ++x)
        {
            xx_[x] = xx_bottom[x] - xx_top[x];
            yy_[x] = yy_bottom[x] - yy_top[x] - 3 * (yy_inner_bottom[x] - yy_inner_top[x]);
            xy_[x] = xy_inner_top[x] - xy_top[x] - (xy_bottom[x] - xy_inner_bottom[x]);
        }
    }

    /** Sums at pixel x of this row; the mask must fit. */
    SecondDerivatives at(int x) const
    {
        const int lobe = mask_.lobe;
        const int reach = mask_.reach();
        const int half = (lobe - 1) / 2;
        const auto* xx = xx_.data() + x;
        const auto* yy = yy_.data() + x;
        const auto* xy = xy_.data() + x;
        return {
            static_cast<std::int32_t>(xx[reach + 1] - xx[-reach] - 3 * (xx[half + 1] - xx[-half])),
            static_cast<std::int32_t>(yy[lobe] - yy[1 - lobe]),
            static_cast<std::int32_t>(xy[0] - xy[-lobe] - (xy[lobe + 1] - xy[1]))};
    }

 private:
    const IntegralImage& integral_;
    BoxMask mask_;
    std::vector<std::uint32_t> xx_;
    std::vector<std::uint32_t> yy_;
    std::vector<std::uint32_t> xy_;
};

/** Smallest multiple of `step` that is not below `value`, divided by `step`. */
int ceil_divide(int value, int step)
{
    return (value + step - 1) / step;
}

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
}  // namespace

HessianLayer::HessianLayer(const IntegralImage& integral, BoxMask box_mask, int sampling_step)
    : mask(box_mask),
      step(sampling_step),
      columns(ceil_divide(integral.width(), sampling_step)),
      rows(ceil_divide(integral.height(), sampling_step)),
      determinant(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0F)
{
}

void fill_determinants(const IntegralImage& integral,
                       HessianLayer& layer,
                       int first_row,
                       int last_row)
{
    const FittingRange fitting_rows(integral.height(), layer);
    const FittingRange fitting_columns(integral.width(), layer);
    const auto area = static_cast<float>(layer.mask.size() * layer.mask.size());
    const float weight = 3.6F / area;
    MaskRow sums(integral, layer.mask);
    for (int r = std::max(first_row, fitting_rows.first); r < std::min(last_row, fitting_rows.last);
         ++r)
    {
        sums.move_to(r * layer.step);
        auto* out = layer.determinant.data() +
                    static_cast<std::size_t>(r) * static_cast<std::size_t>(layer.columns);
        for (int c = fitting_columns.first; c < fitting_columns.last; ++c)
        {
            const auto sum = sums.at(c * layer.step);
            const float dxx = static_cast<float>(sum.xx) * weight;
            const float dyy = static_cast<float>(sum.yy) * weight;
            const float dxy = static_cast<float>(sum.xy) * weight;
            out[c] = dxx * dyy - 0.81F * dxy * dxy;
        }
    }
}

}  // namespace fild
