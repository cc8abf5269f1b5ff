// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/town.h"

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace fild
{
/** A part of a route, drawn in one colour. Value type. */
struct RouteLine
{
    std::string name;  ///< in the legend
    std::vector<cv::Point3d> points;  ///< m, in the order they were driven
};

/** The whole town as seen from the air, with the routes driven through it, an arrow on each every
 *  50 m and a legend. \return 8 bit BGR, `width` pixels wide. */
cv::Mat draw_birds_eye(Town& town,
                       const std::vector<RouteLine>& routes,
                       const LapConditions& conditions,
                       int width = 1600);

}  // namespace fild
