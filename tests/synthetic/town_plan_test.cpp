// SPDX-License-Identifier: BSD-3-Clause
#include "town_plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
fild::TTownOptions with_look_alikes(double share)
{
    fild::TTownOptions options;
    options.look_alikes = share;
    return options;
}

/** How many rows begin with the same house as some row before them. */
int repeated_rows(const fild::TownPlan& plan)
{
    int repeated = 0;
    for (std::size_t i = 0; i < plan.rows.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (plan.rows[i].houses[0].design.width == plan.rows[j].houses[0].design.width)
            {
                ++repeated;
                break;
            }
    return repeated;
}

TEST(StreetGrid, BlocksLieBetweenTheStreets)
{
    const fild::StreetGrid grid;
    EXPECT_EQ(grid.street_width(), 14);
    EXPECT_EQ(grid.crossing(2, 1), cv::Point2d(168, 64));
    const auto block = grid.block(1, 0);
    EXPECT_EQ(block.tl(), cv::Point2d(84 + 7, 7));
    EXPECT_EQ(block.br(), cv::Point2d(168 - 7, 64 - 7));
    EXPECT_EQ(grid.bounds(), cv::Rect2d(-7, -7, 3 * 84 + 14, 2 * 64 + 14));
}

TEST(TownPlan, HousesFillEveryRowWithoutGaps)
{
    const auto plan = fild::plan_town({});
    ASSERT_EQ(plan.rows.size(), 6U * 4U + 2U * 3U + 2U * 2U);
    for (const auto& row : plan.rows)
    {
        double end = 0;
        for (const auto& house : row.houses)
        {
            EXPECT_NEAR(house.offset, end, 1e-9);
            EXPECT_GE(house.design.width, 7);
            EXPECT_LT(house.design.width, 20);
            end += house.design.width;
        }
        EXPECT_NEAR(end, row.length, 1e-9);
    }
}

TEST(TownPlan, EveryFrontFacesAStreet)
{
    const auto plan = fild::plan_town({});
    for (const auto& row : plan.rows)
    {
        const auto in_front = row.at(row.length / 2, plan.grid.street_width() / 2);
        // The middle of a street: a multiple of the pitch in x or in y.
        const auto from_street = [](double at, double pitch)
        { return std::abs(std::remainder(at, pitch)); };
        EXPECT_NEAR(std::min(from_street(in_front.x, 84), from_street(in_front.y, 64)), 0, 1e-9);
    }
}

/** Metres from the middle of the nearest street along y or along x. */
double from_middle(double at, double pitch)
{
    return std::abs(std::remainder(at, pitch));
}

TEST(TownPlan, TreesAndLampsStandOnThePavement)
{
    const auto plan = fild::plan_town({});
    const auto half = plan.grid.carriageway / 2;
    const auto end = plan.grid.crossing(plan.grid.columns, plan.grid.rows);
    for (const auto* places : {&plan.trees, &plan.lamp_posts})
    {
        EXPECT_GT(places->size(), 20U);
        for (const auto& [at, heading, seed] : *places)
        {
            const bool between_y = at.y > -half && at.y < end.y + half;
            const bool between_x = at.x > -half && at.x < end.x + half;
            EXPECT_FALSE(between_y && from_middle(at.x, 84) < half) << at;
            EXPECT_FALSE(between_x && from_middle(at.y, 64) < half) << at;
            EXPECT_TRUE(plan.grid.bounds().contains(at)) << at;
        }
    }
}

TEST(TownPlan, CarsLeaveTheLanesAndTheCrossingsFree)
{
    const auto plan = fild::plan_town({});
    constexpr double kLanes = 2.5;  // m to each side of the middle
    constexpr double kHalfCar = 0.9;
    EXPECT_GT(plan.parking_bays.size(), 100U);
    for (const auto& bay : plan.parking_bays)
    {
        EXPECT_GT(from_middle(bay.at.x, 84), kLanes + kHalfCar) << bay.at;
        EXPECT_GT(from_middle(bay.at.y, 64), kLanes + kHalfCar) << bay.at;
    }
}

TEST(TownPlan, CarsStandInTheDirectionOfTraffic)
{
    const auto plan = fild::plan_town({});
    for (const auto& bay : plan.parking_bays)
    {
        // To the right of a car is the kerb, to its left the middle of the street.
        const cv::Point2d left(-std::sin(bay.heading), std::cos(bay.heading));
        const bool along_x = std::abs(left.x) < 0.5;
        const auto beside = bay.at + left;
        if (along_x)
            EXPECT_LT(from_middle(beside.y, 64), from_middle(bay.at.y, 64));
        else
            EXPECT_LT(from_middle(beside.x, 84), from_middle(bay.at.x, 84));
    }
}

TEST(TownPlan, RepeatsTheAskedShareOfRows)
{
    EXPECT_EQ(repeated_rows(fild::plan_town(with_look_alikes(0))), 0);
    EXPECT_EQ(repeated_rows(fild::plan_town(with_look_alikes(1))), 33);
    const auto some = repeated_rows(fild::plan_town(with_look_alikes(0.3)));
    EXPECT_GT(some, 4);
    EXPECT_LT(some, 18);
}

TEST(TownPlan, LookAlikesAgeDifferently)
{
    const auto plan = fild::plan_town(with_look_alikes(1));
    EXPECT_NE(plan.rows[0].houses[0].wear, plan.rows[1].houses[0].wear);
}

/** A town in which every row but the first repeats another one. */
fild::TownPlan varied_town(double variation)
{
    auto options = with_look_alikes(1);
    options.look_alike_variation = variation;
    return fild::plan_town(options);
}

TEST(TownPlan, LookAlikesDifferByTheAskedVariation)
{
    const auto same = varied_town(0);
    const auto varied = varied_town(1);
    ASSERT_EQ(same.rows.size(), varied.rows.size());
    int other_signs = 0;
    int other_colours = 0;
    for (std::size_t i = 1; i < same.rows.size(); ++i)
    {
        const auto& before = same.rows[i].houses[0].design;
        const auto& after = varied.rows[i].houses[0].design;
        EXPECT_EQ(before.soot, 0);
        EXPECT_LT(after.soot, 1);
        EXPECT_EQ(before.floors, after.floors);
        EXPECT_EQ(before.window, after.window);
        EXPECT_EQ(before.windows_per_floor, after.windows_per_floor);
        EXPECT_GE(after.width, 7);
        other_signs += before.sign != after.sign ? 1 : 0;
        other_colours += cv::norm(before.wall_colour - after.wall_colour) > 10 ? 1 : 0;
    }
    EXPECT_GT(other_signs, 20);
    EXPECT_GT(other_colours, 20);
}

TEST(TownPlan, VariedLookAlikesFillTheirRows)
{
    for (const auto& row : varied_town(1).rows)
    {
        const auto& last = row.houses.back();
        EXPECT_NEAR(last.offset + last.design.width, row.length, 1e-9);
        EXPECT_GE(last.design.width, 7);
    }
}

TEST(TownPlan, VariationLeavesTheOtherHousesAlone)
{
    fild::TTownOptions options;
    options.look_alikes = 0;
    const auto usual = fild::plan_town(options);
    options.look_alike_variation = 1;
    const auto varied = fild::plan_town(options);
    for (std::size_t i = 0; i < usual.rows.size(); ++i)
        EXPECT_EQ(usual.rows[i].houses[0].design.wall_colour,
                  varied.rows[i].houses[0].design.wall_colour);
    options.look_alike_variation = 1.1;
    EXPECT_THROW(options.check(), std::invalid_argument);
}

TEST(TownPlan, OtherCarsStandThereWithAnotherSeed)
{
    const auto plan = fild::plan_town({});
    const auto first = fild::parked_cars(plan, 1);
    const auto again = fild::parked_cars(plan, 1);
    const auto other = fild::parked_cars(plan, 2);
    ASSERT_EQ(first.size(), again.size());
    int same = 0;
    for (std::size_t i = 0; i < std::min(first.size(), other.size()); ++i)
    {
        EXPECT_EQ(first[i].seed, again[i].seed);
        same += first[i].at == other[i].at && first[i].seed == other[i].seed ? 1 : 0;
    }
    EXPECT_EQ(same, 0);
    const auto share =
        static_cast<double>(first.size()) / static_cast<double>(plan.parking_bays.size());
    EXPECT_NEAR(share, 0.45, 0.1);
}

}  // namespace
