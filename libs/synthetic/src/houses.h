// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "town_plan.h"

#include <opencv2/core.hpp>

#include <memory>
#include <vector>

namespace mrpt::opengl
{
class COpenGLScene;
}

namespace fild
{
/** The painted fronts of a row side by side, standing on the lower edge; at the right end, where
 *  the row ends in corners, its two end walls. */
struct RowPicture
{
    cv::Mat picture;
    std::vector<cv::Rect> fronts;  ///< in pixels, a front for each house
    std::vector<cv::Rect> end_walls;  ///< of the first and the last house, or none
};

RowPicture paint_row(const HouseRow& row);

/** Builds fronts, balconies, awnings, walls, roofs and chimneys of all rows.
 *  \param pictures  of paint_row(), a picture for each row. */
void add_houses(mrpt::opengl::COpenGLScene& scene,
                const TownPlan& plan,
                const std::vector<RowPicture>& pictures);

}  // namespace fild
