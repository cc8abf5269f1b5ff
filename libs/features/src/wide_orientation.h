// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "box_hessian.h"
#include "disc_windows.h"
#include "orientation.h"
#include "wide_window_sums.h"

#include <algorithm>

namespace fild
{
/** Fills an orientation disc's grid, kCount columns at a time, to the same bits as the portable
 *  code. */
template <int kCount>
class WideDiscGrid
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;
    using Sums = typename L::Sums;
    using Between = WideBetween<kCount>;
    using Pair = WidePair<kCount>;
    static constexpr std::size_t kVectors = (DiscGrid::lines + kCount - 1) / kCount;

 public:
    FILD_IN_LANES WideDiscGrid(const IntegralImage& integral, const Keypoint& keypoint)
        : integral_(integral)
    {
        grid_.step = scale_of_mask(keypoint.size);
        const auto y = lines(keypoint.y, integral.height(), grid_.inside_y);
        const auto x = lines(keypoint.x, integral.width(), grid_.inside_x);
        for (std::size_t v = 0; v < kVectors; ++v) fill_columns(v * kCount, x, y);
    }

    FILD_IN_LANES const DiscGrid& grid() const { return grid_; }

 private:
    /** Lines along one axis. */
    struct Lines
    {
        std::array<std::int32_t, DiscGrid::padded> index{};
        DiscGrid::Line fraction{};
    };

    FILD_IN_LANES Lines lines(float keypoint, int pixels, DiscGrid::Line& inside) const
    {
        const Floats zero{};
        const Floats end = L::all(static_cast<float>(pixels));
        Lines lines;
        for (std::size_t i = 0; i < kVectors * kCount; i += kCount)
        {
            const Floats position =
                keypoint + 0.5F + grid_.step * L::template load<Floats>(kOffsets.data() + i);
            const Floats in_image = L::larger(L::smaller(position, end), zero);
            const Between at(in_image, pixels);
            L::store(at.index, lines.index.data() + i);
            L::store(at.fraction, lines.fraction.data() + i);
            L::store(in_image == position ? L::all(1) : zero, inside.data() + i);
        }
        return lines;
    }

    FILD_IN_LANES void fill_columns(std::size_t first, const Lines& x, const Lines& y)
    {
        const auto columns = L::template load<typename L::Ints>(x.index.data() + first);
        const auto fractions = L::template load<Floats>(x.fraction.data() + first);
        const std::int32_t left = x.index[0];
        const auto* top = integral_.row(y.index[0]);
        const Pair above(top, columns);
        for (std::size_t row = 0; row < DiscGrid::lines; ++row)
        {
            const auto* upper = integral_.row(y.index[row]);
            const auto* lower = upper + integral_.stride();
            const Pair up(upper, columns);
            const Pair low(lower, columns);
            const Floats fraction = L::all(y.fraction[row]);
            const Floats first_sum =
                interpolate_lanes(L::to_floats(up.first - upper[left] - (above.first - top[left])),
                                  L::to_floats(low.first - lower[left] - (above.first - top[left])),
                                  fraction);
            const Floats second_sum = interpolate_lanes(
                L::to_floats(up.second - upper[left] - (above.second - top[left])),
                L::to_floats(low.second - lower[left] - (above.second - top[left])),
                fraction);
            L::store(interpolate_lanes(first_sum, second_sum, fractions),
                     grid_.sums[row].data() + first);
        }
    }

    static constexpr DiscGrid::Line offsets()
    {
        DiscGrid::Line offsets{};
        for (std::size_t i = 0; i < DiscGrid::padded; ++i)
            offsets[i] = DiscGrid::offset(std::min(i, DiscGrid::lines - 1));
        return offsets;
    }
    static constexpr DiscGrid::Line kOffsets = offsets();

    const IntegralImage& integral_;
    DiscGrid grid_;
};

/** dominant_orientation(), orientation.h, to the same bits. The 17 lines of the grid need 3 vectors
 *  of 8 numbers, which leaves fewer of them unused than 2 of 16. */
template <int kCount>
FILD_IN_LANES float dominant_orientation_in_lanes(const IntegralImage& integral,
                                                  const Keypoint& keypoint)
{
    const WideDiscGrid<8> lines(integral, keypoint);
    return strongest_direction<kCount>(disc_responses<kCount>(lines.grid()));
}

}  // namespace fild
