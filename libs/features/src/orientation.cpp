// SPDX-License-Identifier: BSD-3-Clause
// Orientation assignment: SURF (CVIU 2008) section 4.1.
#include "orientation.h"

#include "box_hessian.h"
#include "disc_windows.h"
#include "window_sums.h"

#include <cmath>
#include <vector>

namespace fild
{
namespace
{
/** Lines along one axis. */
struct Lines
{
    std::vector<Between> at;
    DiscGrid::Line inside{};

    Lines(float keypoint, float step, int pixels)
    {
        const auto end = static_cast<float>(pixels);
        for (std::size_t i = 0; i < DiscGrid::lines; ++i)
        {
            const float position = keypoint + 0.5F + step * DiscGrid::offset(i);
            inside[i] = position >= 0 && position <= end ? 1.0F : 0.0F;
            at.emplace_back(std::clamp(position, 0.0F, end), pixels + 1);
        }
    }
};

DiscGrid grid_around(const IntegralImage& integral, const Keypoint& keypoint)
{
    DiscGrid grid;
    grid.step = scale_of_mask(keypoint.size);
    const Lines x(keypoint.x, grid.step, integral.width());
    const Lines y(keypoint.y, grid.step, integral.height());
    grid.inside_x = x.inside;
    grid.inside_y = y.inside;
    const WindowSums sums(integral, x.at.front(), y.at.front());
    for (std::size_t row = 0; row < DiscGrid::lines; ++row)
        for (std::size_t column = 0; column < DiscGrid::lines; ++column)
            grid.sums[row][column] = sums.at(x.at[column], y.at[row]);
    return grid;
}
}  // namespace

float dominant_orientation(const IntegralImage& integral, const Keypoint& keypoint)
{
    constexpr int kLanesOfAnyProcessor = 4;
    const auto responses = disc_responses<kLanesOfAnyProcessor>(grid_around(integral, keypoint));
    return strongest_direction<kLanesOfAnyProcessor>(responses);
}

float angle_of(float dx, float dy)
{
    constexpr float kTwoPi = 6.2831853071795864769F;
    const auto angle = static_cast<float>(std::atan2(double{dy}, double{dx}));
    const float positive = angle < 0 ? angle + kTwoPi : angle;
    return positive < kTwoPi ? positive : 0.0F;
}

}  // namespace fild
