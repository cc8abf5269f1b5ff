// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "town_plan.h"

namespace fild
{
/** Paints roads, pavements and courtyards of a part of the town, seen from above: x to the right,
 *  y upwards. \param area  metres. */
cv::Mat paint_ground(const TownPlan& plan, const cv::Rect2d& area, std::uint64_t seed);

/** Darkens what lies in the shadow of houses and trees. \param canvas  of paint_ground().
 *  \param shadow  horizontal metres of shadow per metre of height, and where to. */
void cast_shadows(cv::Mat& canvas,
                  const cv::Rect2d& area,
                  const TownPlan& plan,
                  const cv::Point2d& shadow);

/** Wet ground, pale lawns, and fallen leaves under the trees and along the kerbs.
 *  \param canvas  of paint_ground(). \param season  (0, 1]. */
void weather_ground(cv::Mat& canvas, const cv::Rect2d& area, const TownPlan& plan, double season);

}  // namespace fild
