// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

#include <vector>

namespace fild
{
/** The part of the ground that a map's pictures show. */
struct GroundGrid
{
    cv::Rect2d area;  ///< metres
    double height = 0;  ///< z of the lowest point, metres
    double climb = 0;  ///< from there to the highest point, metres
    double step = 1;  ///< between two lines, metres: 1, 2 or 5 times a power of ten
    /** True: x is up in the picture and y to the left, which fills it better; false: x to the
     *  right, y up. */
    bool is_turned = false;

    double size() const { return std::max(area.width, area.height); }

    /** Where lines of one x (or y) stand, ascending. */
    std::vector<double> lines_of_x() const;
    std::vector<double> lines_of_y() const;
};

/** The grid under some points, with a margin, at least some metres wide, of the shape of the
 *  picture. \param points  at least one. \param shape  of the picture it shall fill. */
GroundGrid ground_under(const std::vector<cv::Vec3d>& points, const cv::Size2d& shape);

}  // namespace fild
