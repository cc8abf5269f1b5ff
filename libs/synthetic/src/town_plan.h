// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "facade.h"
#include "fild/synthetic/street_grid.h"
#include "fild/synthetic/town_options.h"

#include <opencv2/core/types.hpp>

#include <cstdint>
#include <vector>

namespace fild
{
constexpr double kHouseDepth = 10;  ///< m, behind the front
constexpr double kKerbHeight = 0.12;  ///< m, of the pavement over the road

/** One house of a row. Value type. */
struct House
{
    double offset = 0;  ///< m from the start of the row to the left edge of the front
    FacadeDesign design;
    std::uint64_t wear = 0;
};

/** Houses side by side along a street. As seen from the street `along` points to the right. */
struct HouseRow
{
    cv::Point2d start;  ///< left end of the fronts
    cv::Point2d along;  ///< unit vector
    double length = 0;  ///< m
    bool ends_in_corners = false;  ///< then the end walls stand on other streets and have windows
    std::vector<House> houses;

    /** Unit vector from the fronts into the street. */
    cv::Point2d outward() const { return {along.y, -along.x}; }
    /** The point `right` metres along the row and `out` metres into the street. */
    cv::Point2d at(double right, double out) const
    {
        return start + right * along + out * outward();
    }
};

/** Something on the ground: where and which way it faces. */
struct StandingObject
{
    cv::Point2d at;  ///< m
    double heading = 0;  ///< rad
    std::uint64_t seed = 0;  ///< of its looks
};

/** Where everything stands. Value type. */
struct TownPlan
{
    StreetGrid grid;
    std::vector<HouseRow> rows;
    std::vector<StandingObject> trees;
    std::vector<StandingObject> lamp_posts;
    std::vector<StandingObject> parking_bays;  ///< where a car may stand, heading with the traffic
};

TownPlan plan_town(const TTownOptions& options);

/** The bays in which a car stands, with a seed for its looks each. */
std::vector<StandingObject> parked_cars(const TownPlan& plan, std::uint64_t seed);

}  // namespace fild
