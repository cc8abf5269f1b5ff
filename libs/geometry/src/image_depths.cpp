// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/image_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/** NaN where there is none. */
double interpolated_depth(const cv::Mat& depth, const PixelPosition& pixel, double max_step)
{
    const auto x = static_cast<double>(pixel.x);
    const auto y = static_cast<double>(pixel.y);
    const bool inside = x >= 0 && y >= 0 && x <= depth.cols - 1 && y <= depth.rows - 1;
    if (!inside || depth.cols < 2 || depth.rows < 2) return static_cast<double>(kUnknown);
    const int column = std::min(static_cast<int>(x), depth.cols - 2);
    const int row = std::min(static_cast<int>(y), depth.rows - 2);
    const auto at = [&](int dy, int dx)
    { return static_cast<double>(depth.at<float>(row + dy, column + dx)); };
    const std::array<double, 4> corners{at(0, 0), at(0, 1), at(1, 0), at(1, 1)};
    const bool known = std::all_of(
        corners.begin(), corners.end(), [](double z) { return z > 0 && std::isfinite(z); });
    if (!known) return static_cast<double>(kUnknown);
    const auto [near, far] = std::minmax_element(corners.begin(), corners.end());
    if (*far - *near > max_step * *near) return static_cast<double>(kUnknown);
    const double right = x - column;
    const double down = y - row;
    return 1 / ((1 - down) * ((1 - right) / corners[0] + right / corners[1]) +
                down * ((1 - right) / corners[2] + right / corners[3]));
}
/** True when the surface goes on as a plane for some pixels on all sides: what a blob shows beside
 *  an edge in depth is on no one surface. On a plane second differences of inverse depth are 0. */
bool is_on_a_surface(const cv::Mat& depth, const PixelPosition& pixel, double max_step)
{
    constexpr int kReach = 3;
    constexpr std::array<std::pair<int, int>, 4> kDirections{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    const int x = static_cast<int>(std::lround(pixel.x));
    const int y = static_cast<int>(std::lround(pixel.y));
    if (x < kReach || y < kReach || x + kReach >= depth.cols || y + kReach >= depth.rows)
        return false;
    const auto inverse_at = [&](int dx, int dy)
    { return 1 / static_cast<double>(depth.at<float>(y + dy, x + dx)); };
    const double here = inverse_at(0, 0);
    return std::all_of(kDirections.begin(),
                       kDirections.end(),
                       [&](const auto& d)
                       {
                           const double there = inverse_at(kReach * d.first, kReach * d.second);
                           const double back = inverse_at(-kReach * d.first, -kReach * d.second);
                           return there > 0 && back > 0 &&
                                  std::abs(there + back - 2 * here) <= max_step * here;
                       });
}
}  // namespace

KeypointDepths depths_from_image(const Frame& frame,
                                 const std::vector<PixelPosition>& positions,
                                 const TDepthOptions& options)
{
    options.check();
    if (frame.depth.type() != CV_32FC1 || frame.depth.empty())
        throw std::invalid_argument("depths_from_image: the frame has no depth image of floats");
    KeypointDepths depths;
    depths.source = DepthSource::depth_image;
    depths.metres.assign(positions.size(), kUnknown);
    depths.deviations_m.assign(positions.size(), kUnknown);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
        const double z = interpolated_depth(frame.depth, positions[i], options.max_step);
        const double deviation =
            options.sensor_deviation_m + options.sensor_deviation_per_m2 * z * z;
        if (!(z >= options.min_depth_m) || deviation > options.max_relative_deviation * z ||
            !is_on_a_surface(frame.depth, positions[i], options.max_step))
            continue;
        depths.metres[i] = static_cast<float>(z);
        depths.deviations_m[i] = static_cast<float>(deviation);
    }
    return depths;
}

}  // namespace fild
