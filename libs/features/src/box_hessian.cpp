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
        const MaskEdges row(integral_, mask_, y);
        for (std::size_t x = 0; x < xx_.size(); ++x)
        {
            xx_[x] = row.xx_bottom[x] - row.xx_top[x];
            yy_[x] = row.yy_bottom[x] - row.yy_top[x] -
                     3 * (row.yy_inner_bottom[x] - row.yy_inner_top[x]);
            xy_[x] =
                row.xy_inner_top[x] - row.xy_top[x] - (row.xy_bottom[x] - row.xy_inner_bottom[x]);
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

}  // namespace

HessianLayer::HessianLayer(const IntegralImage& integral, BoxMask box_mask, int sampling_step)
    : HessianLayer(integral, box_mask, sampling_step, 0, integral.height())
{
}

HessianLayer::HessianLayer(
    const IntegralImage& integral, BoxMask box_mask, int sampling_step, int first, int last)
    : mask(box_mask),
      step(sampling_step),
      columns(ceil_divide(integral.width(), sampling_step)),
      rows(ceil_divide(integral.height(), sampling_step)),
      first_row(std::max(first, 0))
{
    const int held = std::max(std::min(last, rows) - first_row, 0);
    determinant.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(held));
}

MaskEdges::MaskEdges(const IntegralImage& integral, BoxMask mask, int y)
    : xx_top(integral.row(y - mask.lobe + 1)),
      xx_bottom(integral.row(y + mask.lobe)),
      yy_top(integral.row(y - mask.reach())),
      yy_inner_top(integral.row(y - (mask.lobe - 1) / 2)),
      yy_inner_bottom(integral.row(y + (mask.lobe - 1) / 2 + 1)),
      yy_bottom(integral.row(y + mask.reach() + 1)),
      xy_top(integral.row(y - mask.lobe)),
      xy_inner_top(integral.row(y)),
      xy_inner_bottom(integral.row(y + 1)),
      xy_bottom(integral.row(y + mask.lobe + 1))
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
        auto* out = layer.row(r);
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
