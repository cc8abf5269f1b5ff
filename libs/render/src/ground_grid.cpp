// SPDX-License-Identifier: BSD-3-Clause
#include "ground_grid.h"

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
constexpr double kLeastSize = 2;  // metres: a robot that stood still has a place, too
constexpr double kMargin = 0.06;  // of the larger side
constexpr double kLines = 12;  // along the longer side, about

/** The next of 1, 2 and 5 times a power of ten. */
double round_up(double length)
{
    const double power = std::pow(10, std::floor(std::log10(length)));
    for (const double digit : {1, 2, 5})
        if (digit * power >= length * (1 - 1e-9)) return digit * power;
    return 10 * power;
}

std::vector<double> lines_between(double first, double last, double step)
{
    std::vector<double> lines;
    const double from = std::ceil(first / step - 1e-9);
    const double to = std::floor(last / step + 1e-9);
    for (double i = from; i <= to; ++i) lines.push_back(i * step);
    return lines;
}

/** As large as fits into a rectangle of the shape. */
cv::Size2d widened(const cv::Size2d& size, const cv::Size2d& shape)
{
    const double scale = std::max(size.width / shape.width, size.height / shape.height);
    return {scale * shape.width, scale * shape.height};
}
}  // namespace

std::vector<double> GroundGrid::lines_of_x() const
{
    return lines_between(area.x, area.br().x, step);
}

std::vector<double> GroundGrid::lines_of_y() const
{
    return lines_between(area.y, area.br().y, step);
}

GroundGrid ground_under(const std::vector<cv::Vec3d>& points, const cv::Size2d& shape)
{
    cv::Vec3d low = points.front();
    cv::Vec3d high = points.front();
    for (const auto& point : points)
        for (int i = 0; i < 3; ++i)
        {
            low[i] = std::min(low[i], point[i]);
            high[i] = std::max(high[i], point[i]);
        }
    // A climb needs some ground below it, or the perspective shows a needle.
    const double climb = high[2] - low[2];
    const double least = std::max(kLeastSize, 0.3 * climb);
    cv::Size2d size(std::max(high[0] - low[0], least), std::max(high[1] - low[1], least));
    const double margin = 2 * kMargin * std::max(size.width, size.height);
    size += cv::Size2d(margin, margin);

    GroundGrid grid;
    const cv::Size2d turned_shape(shape.height, shape.width);
    const auto upright = widened(size, shape);
    const auto turned = widened(size, turned_shape);
    grid.is_turned = 1.15 * turned.area() < upright.area();
    const auto& area = grid.is_turned ? turned : upright;
    grid.area = {(low[0] + high[0] - area.width) / 2,
                 (low[1] + high[1] - area.height) / 2,
                 area.width,
                 area.height};
    grid.height = low[2];
    grid.climb = climb;
    grid.step = round_up(grid.size() / kLines);
    return grid;
}

}  // namespace fild
