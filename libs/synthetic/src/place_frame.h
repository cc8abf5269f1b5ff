// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "town_plan.h"

#include <cmath>

namespace fild
{
/** Turns metres ahead, to the left and up from a place into points of the town. */
class PlaceFrame
{
 public:
    PlaceFrame(const StandingObject& place, double base) : place_(place), base_(base) {}

    cv::Point3d at(double ahead, double left, double up) const
    {
        const auto c = std::cos(place_.heading);
        const auto s = std::sin(place_.heading);
        return {place_.at.x + c * ahead - s * left, place_.at.y + s * ahead + c * left, base_ + up};
    }

 private:
    StandingObject place_;
    double base_;
};

}  // namespace fild
