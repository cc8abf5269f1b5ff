// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gaussian.h"
#include "lanes.h"
#include "orientation.h"

#include <cstddef>

namespace fild
{
constexpr DiscGrid::Line disc_weights()
{
    DiscGrid::Line weights{};
    for (std::size_t i = 0; i < DiscGrid::lines; ++i)
        weights[i] = gaussian(static_cast<double>(DiscGrid::offset(i)), 2.5);
    return weights;
}
/** The Gaussian's factor along either axis, of the grid's lines. */
inline constexpr auto kDiscWeights = disc_weights();

/** Haar wavelet responses, haar_wavelet.h, of the windows between lines of the grid. Those that
 *  leave the image are 0. To the same bits for any kCount. */
template <int kCount>
class DiscWavelets
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;

 public:
    FILD_IN_LANES explicit DiscWavelets(const DiscGrid& grid) : grid_(grid)
    {
        const float side = static_cast<float>(2 * OrientationDisc::half_wavelet) * grid.step;
        per_half_ = 2.0F / (side * side);
    }

    /** Stores kCount responses: at the crossings of line `row` with line `column` and those after
     *  it. */
    FILD_IN_LANES void store(std::size_t row, std::size_t column, float* dx, float* dy) const
    {
        constexpr std::size_t kHalf = OrientationDisc::half_wavelet;
        const auto& top = grid_.sums[row - kHalf];
        const auto& middle = grid_.sums[row];
        const auto& bottom = grid_.sums[row + kHalf];
        const std::size_t left = column - kHalf;
        const std::size_t right = column + kHalf;
        const Floats whole = at(bottom, right) - at(bottom, left) - at(top, right) + at(top, left);
        const Floats left_half =
            at(bottom, column) - at(bottom, left) - at(top, column) + at(top, left);
        const Floats upper_half =
            at(middle, right) - at(middle, left) - at(top, right) + at(top, left);
        const float inside_y = grid_.inside_y[row - kHalf] * grid_.inside_y[row + kHalf];
        const Floats weights = at(kDiscWeights, column) * (kDiscWeights[row] * inside_y) *
                               (at(grid_.inside_x, left) * at(grid_.inside_x, right));
        L::store(weights * ((whole - 2.0F * left_half) * per_half_), dx);
        L::store(weights * ((whole - 2.0F * upper_half) * per_half_), dy);
    }

 private:
    FILD_IN_LANES static Floats at(const DiscGrid::Line& line, std::size_t column)
    {
        return L::template load<Floats>(line.data() + column);
    }

    const DiscGrid& grid_;
    float per_half_;
};

template <int kCount>
FILD_IN_LANES DiscResponses disc_responses(const DiscGrid& grid)
{
    constexpr std::size_t kMiddle = DiscGrid::lines / 2;
    constexpr std::size_t kRadius = OrientationDisc::radius;
    const DiscWavelets<kCount> wavelets(grid);
    DiscResponses responses;
    std::size_t first = 0;
    for (std::size_t row = kMiddle - kRadius; row <= kMiddle + kRadius; ++row)
    {
        // What a row's last vector has too much is overwritten by the next row.
        const std::size_t half =
            OrientationDisc::half_width(row < kMiddle ? kMiddle - row : row - kMiddle);
        for (std::size_t i = 0; i <= 2 * half; i += kCount)
            wavelets.store(row,
                           kMiddle - half + i,
                           responses.dx.data() + first + i,
                           responses.dy.data() + first + i);
        first += 2 * half + 1;
    }
    return responses;
}

/** The sums of an orientation disc's responses over windows of pi/3, one that begins at each
 *  response: SURF section 4.1. Each response is held against all windows, kCount at a time, which
 *  takes less time than sorting them. To the same bits for any kCount. */
template <int kCount>
class DiscWindows
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    using Sums = typename L::Sums;

 public:
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): it fills all of them
    FILD_IN_LANES explicit DiscWindows(const DiscResponses& responses) : responses_(responses)
    {
        for (std::size_t i = 0; i < OrientationDisc::padded; i += kCount)
            L::store(angles(L::template load<Floats>(responses.dx.data() + i),
                            L::template load<Floats>(responses.dy.data() + i)),
                     angle_.data() + i);
        for (std::size_t i = 0; i < OrientationDisc::padded; i += kVectors * kCount) sum_up(i);
    }

    struct Sum
    {
        float dx = 0;
        float dy = 0;
    };

    FILD_IN_LANES Sum longest() const
    {
        Sum longest;
        float longest_squared = 0;
        for (std::size_t i = 0; i < OrientationDisc::samples; ++i)
        {
            if (responses_.dx[i] == 0 && responses_.dy[i] == 0) continue;
            const float squared = dx_[i] * dx_[i] + dy_[i] * dy_[i];
            if (squared <= longest_squared) continue;
            longest_squared = squared;
            longest = {dx_[i], dy_[i]};
        }
        return longest;
    }

 private:
    /** Vectors of windows at a time, so that additions do not wait for one another. */
    static constexpr std::size_t kVectors = kCount < 8 ? 4 : 32 / kCount;
    /** Angles are counted in 2^-32 of the circle: their differences wrap around by themselves. */
    static constexpr std::uint32_t kHalfCircle = 0x80000000U;
    static constexpr std::uint32_t kWindow = 0x2AAAAAABU;

    /** Directions from -pi to pi, to 1e-6 radians. The polynomial is the one of its degree with the
     *  least error, 4e-8, on [0, 1] (Remez' algorithm). */
    FILD_IN_LANES static Ints angles(const Floats& dx, const Floats& dy)
    {
        constexpr float kPi = 3.14159265359F;
        const Floats zero{};
        const Floats along_x = L::magnitude(dx);
        const Floats along_y = L::magnitude(dy);
        const Floats longer = L::larger(along_x, along_y);
        const Floats tangent = L::smaller(along_x, along_y) / (longer > zero ? longer : L::all(1));
        const Floats z = tangent * tangent;
        Floats factor = 0.02186298770996206F - 0.0040545756247751F * z;
        factor = factor * z - 0.05591236871686635F;
        factor = factor * z + 0.09642200300271231F;
        factor = factor * z - 0.13908630664212648F;
        factor = factor * z + 0.19946565862719348F;
        factor = factor * z - 0.33329860801740613F;
        factor = factor * z + 0.9999993355824159F;
        Floats angle = factor * tangent;
        angle = along_x > along_y ? angle : kPi / 2 - angle;
        angle = dx < zero ? kPi - angle : angle;
        angle = dy < zero ? -angle : angle;
        constexpr float kUnits = 2147483000.0F;  // a little less than 2^31: no rounding reaches it
        const Floats scaled = angle * (kUnits / kPi);
        return __builtin_convertvector(scaled, Ints);
    }

    /** The windows that begin at responses first, first + 1... */
    FILD_IN_LANES void sum_up(std::size_t first)
    {
        const Floats zero{};
        Sums opposite[kVectors];
        Floats dx[kVectors] = {};
        Floats dy[kVectors] = {};
        for (std::size_t v = 0; v < kVectors; ++v)
            opposite[v] = L::template load<Sums>(angle_.data() + first + v * kCount) + kHalfCircle;
        for (std::size_t i = 0; i < OrientationDisc::samples; ++i)
            for (std::size_t v = 0; v < kVectors; ++v)
            {
                // From -pi at the beginning of the window: processors compare signed numbers.
                const Ints after =
                    reinterpret_cast<Ints>(static_cast<std::uint32_t>(angle_[i]) - opposite[v]);
                // Written otherwise, GCC 12 makes each lane of 16 by itself.
                constexpr auto kEnd = static_cast<std::int32_t>(kWindow - kHalfCircle);
                dx[v] += after < kEnd ? responses_.dx[i] - zero : zero;
                dy[v] += after < kEnd ? responses_.dy[i] - zero : zero;
            }
        for (std::size_t v = 0; v < kVectors; ++v)
        {
            L::store(dx[v], dx_.data() + first + v * kCount);
            L::store(dy[v], dy_.data() + first + v * kCount);
        }
    }

    const DiscResponses& responses_;
    std::array<std::int32_t, OrientationDisc::padded> angle_;
    std::array<float, OrientationDisc::padded> dx_;
    std::array<float, OrientationDisc::padded> dy_;
};

/** Direction of the longest sum, radians in [0, 2 pi); 0 where all are 0. */
template <int kCount>
FILD_IN_LANES float strongest_direction(const DiscResponses& responses)
{
    const DiscWindows<kCount> windows(responses);
    const auto sum = windows.longest();
    return angle_of(sum.dx, sum.dy);
}

}  // namespace fild
