// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>

namespace fild
{
/** Streets along x and y that cross at right angles, with house blocks between them. Lengths in
 *  metres; the origin is the middle of crossing (0, 0), z = 0 is the road. Value type. */
struct StreetGrid
{
    int columns = 3;  ///< house blocks along x
    int rows = 2;  ///< house blocks along y
    double block_length = 70;  ///< of a block's house fronts, along x
    double block_width = 50;  ///< along y
    double carriageway = 9;  ///< two lanes and a row of parked cars on each side
    double pavement = 2.5;  ///< on each side of the carriageway

    double street_width() const { return carriageway + 2 * pavement; }

    /** Where the centre lines of two streets meet; 0 <= i <= columns, 0 <= j <= rows. */
    cv::Point2d crossing(int i, int j) const
    {
        return {i * (block_length + street_width()), j * (block_width + street_width())};
    }

    /** The house fronts of the block between crossings (i, j) and (i + 1, j + 1). */
    cv::Rect2d block(int i, int j) const
    {
        const auto corner = crossing(i, j);
        return {corner.x + street_width() / 2,
                corner.y + street_width() / 2,
                block_length,
                block_width};
    }

    /** All streets; houses stand around it. */
    cv::Rect2d bounds() const
    {
        const auto far_corner = crossing(columns, rows);
        return {-street_width() / 2,
                -street_width() / 2,
                far_corner.x + street_width(),
                far_corner.y + street_width()};
    }
};

}  // namespace fild
