// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integral_image.h"
#include "wide_window_sums.h"

#include <limits>

namespace fild
{
/** haar_response() of kCount windows of one side at a time, to the same bits: haar_wavelet.h. */
template <int kCount>
class WideHaar
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    using Sums = typename L::Sums;
    using Between = WideBetween<kCount>;
    using Pair = WidePair<kCount>;

 public:
    struct Responses
    {
        Floats dx;
        Floats dy;
    };

    /** Entries are counted in 32 bits. */
    FILD_IN_LANES static bool can_read(const IntegralImage& integral)
    {
        const auto entries = std::int64_t{integral.stride()} * (integral.height() + 1);
        return entries <= std::numeric_limits<std::int32_t>::max();
    }

    /** \param integral  can_read() it. */
    FILD_IN_LANES WideHaar(const IntegralImage& integral, float side)
        : sums_(integral.row(0)),
          stride_(integral.stride()),
          width_(integral.width()),
          height_(integral.height()),
          side_(side)
    {
    }

    FILD_IN_LANES Responses at(const Floats& x, const Floats& y) const
    {
        const Floats zero{};
        const float half = 0.5F * side_;
        const Floats centre_x = x + 0.5F;
        const Floats centre_y = y + 0.5F;
        const Floats margin_x =
            L::smaller(centre_x - half, static_cast<float>(width_) - (centre_x + half));
        const Floats margin_y =
            L::smaller(centre_y - half, static_cast<float>(height_) - (centre_y + half));
        const Floats margin = L::smaller(margin_x, margin_y);

        // Windows that leave the image are read at its corner, and count as 0.
        const Columns columns{Between(margin >= 0 ? centre_x - half : zero, width_),
                              Between(margin >= 0 ? centre_x : zero, width_),
                              Between(margin >= 0 ? centre_x + half : zero, width_)};
        const Between top(margin >= 0 ? centre_y - half : zero, height_);
        const Between centre(margin >= 0 ? centre_y : zero, height_);
        const Between bottom(margin >= 0 ? centre_y + half : zero, height_);

        const Entries top_entries(*this, columns, top);
        const Edge upper = edge(top_entries, top_entries, columns, top);
        const Edge middle = edge(Entries(*this, columns, centre), top_entries, columns, centre);
        const Edge lower = edge(Entries(*this, columns, bottom), top_entries, columns, bottom);
        const Floats whole = lower.right - lower.left - upper.right + upper.left;
        const Floats left_half = lower.middle - lower.left - upper.middle + upper.left;
        const Floats upper_half = middle.right - middle.left - upper.right + upper.left;
        const float per_half = 2.0F / (side_ * side_);
        return {margin >= 0 ? (whole - 2.0F * left_half) * per_half : zero,
                margin >= 0 ? (whole - 2.0F * upper_half) * per_half : zero};
    }

 private:
    struct Columns
    {
        Between left;
        Between middle;
        Between right;
    };

    /** The four entries around a point. */
    struct Corners
    {
        Pair upper;
        Pair lower;

        FILD_IN_LANES Corners(const WideHaar& haar, const Ints& row, const Between& x)
            : upper(haar.sums_, row + x.index), lower(haar.sums_ + haar.stride_, row + x.index)
        {
        }
    };

    /** The entries around three points at the same height. */
    struct Entries
    {
        Corners left;
        Corners middle;
        Corners right;

        FILD_IN_LANES Entries(const WideHaar& haar, const Columns& columns, const Between& y)
            : left(haar, y.index * haar.stride_, columns.left),
              middle(haar, y.index * haar.stride_, columns.middle),
              right(haar, y.index * haar.stride_, columns.right)
        {
        }
    };

    /** The integral image along a horizontal edge of the window or of its halves. */
    struct Edge
    {
        Floats left;
        Floats middle;
        Floats right;
    };

    FILD_IN_LANES static Edge edge(const Entries& entries,
                                   const Entries& top,
                                   const Columns& columns,
                                   const Between& y)
    {
        return {sum_at(entries.left, entries.left, top.left, top.left, columns.left, y),
                sum_at(entries.middle, entries.left, top.middle, top.left, columns.middle, y),
                sum_at(entries.right, entries.left, top.right, top.left, columns.right, y)};
    }

    /** The integral image of the window alone, which starts at the first upper entry of `top_left`.
     *  */
    FILD_IN_LANES static Floats sum_at(const Corners& corners,
                                       const Corners& left,
                                       const Corners& top,
                                       const Corners& top_left,
                                       const Between& x,
                                       const Between& y)
    {
        const Sums above_first = top.upper.first - top_left.upper.first;
        const Sums above_second = top.upper.second - top_left.upper.first;
        return interpolate_lanes(
            interpolate_lanes(L::to_floats(corners.upper.first - left.upper.first - above_first),
                              L::to_floats(corners.lower.first - left.lower.first - above_first),
                              y.fraction),
            interpolate_lanes(L::to_floats(corners.upper.second - left.upper.first - above_second),
                              L::to_floats(corners.lower.second - left.lower.first - above_second),
                              y.fraction),
            x.fraction);
    }

    const std::uint32_t* sums_;
    int stride_;
    int width_;
    int height_;
    float side_;
};

}  // namespace fild
