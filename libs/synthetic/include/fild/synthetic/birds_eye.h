// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/route.h"
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

/** The parts of a route for drawing: "lap 1", "lap 2", ..., "driven once", "opposite direction",
 * and "connecting road" for the links. A part may begin again elsewhere: then it comes as a second line of
 * the same name. Each begins where the one before ends. */
std::vector<RouteLine> route_lines(const std::vector<RoutePose>& route);

/** The whole town as seen from the air, with the routes driven through it, an arrow on each every
 *  50 m, start, end and a legend; lines of one name share their colour. The heading at the start is
 *  to the right, as the x axis is on the map of a run that begins there. \return 8 bit BGR, `width`
 *  pixels wide.
 */
cv::Mat draw_birds_eye(Town& town,
                       const std::vector<RouteLine>& routes,
                       const LapConditions& conditions,
                       int width = 1600);

}  // namespace fild
