// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/road_users.h"

#include "fild/synthetic/synthetic_options.h"
#include "lane_traffic.h"
#include "town_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using fild::plan_route;
using fild::Preset;
using fild::RoadUser;
using fild::RoadUserKind;
using fild::RoadUsers;
using fild::RoutePose;
using fild::StreetGrid;

std::vector<RoutePose> hard_route(std::uint64_t seed = 1)
{
    return plan_route(options_of(Preset::hard).route, StreetGrid(), seed);
}

/** A point as a vehicle sees it: metres ahead of its middle and to its left. */
cv::Point2d seen_from(const RoadUser& vehicle, double x, double y)
{
    const double c = std::cos(vehicle.heading);
    const double s = std::sin(vehicle.heading);
    return {c * (x - vehicle.x) + s * (y - vehicle.y), c * (y - vehicle.y) - s * (x - vehicle.x)};
}

/** Whether a point is on a vehicle or within a margin of it. */
bool covers(const RoadUser& vehicle, double x, double y, double margin)
{
    const auto point = seen_from(vehicle, x, y);
    const auto size = fild::size_of(vehicle.kind);
    return std::abs(point.x) < size.width / 2 + margin &&
           std::abs(point.y) < size.height / 2 + margin;
}

/** Points along both sides of a vehicle and of its middle. */
std::vector<cv::Point2d> outline_of(const RoadUser& vehicle)
{
    const auto size = fild::size_of(vehicle.kind);
    std::vector<cv::Point2d> points;
    for (const double ahead : {-0.5, -0.25, 0.0, 0.25, 0.5})
        for (const double left : {-0.5, 0.0, 0.5})
        {
            const double a = ahead * size.width;
            const double b = left * size.height;
            const double c = std::cos(vehicle.heading);
            const double s = std::sin(vehicle.heading);
            points.emplace_back(vehicle.x + c * a - s * b, vehicle.y + s * a + c * b);
        }
    return points;
}

bool overlap(const RoadUser& a, const RoadUser& b)
{
    for (const auto& point : outline_of(a))
        if (covers(b, point.x, point.y, 0)) return true;
    return false;
}

std::vector<RoadUser> vehicles(const std::vector<RoadUser>& users)
{
    std::vector<RoadUser> chosen;
    std::copy_if(users.begin(),
                 users.end(),
                 std::back_inserter(chosen),
                 [](const RoadUser& user) { return user.kind != RoadUserKind::pedestrian; });
    return chosen;
}

TEST(RoadUsers, AreNoneAtDensityZero)
{
    const RoadUsers nobody(0, hard_route(), StreetGrid(), 1);
    EXPECT_TRUE(nobody.at(0).empty());
    EXPECT_TRUE(nobody.at(100).empty());
    EXPECT_TRUE(RoadUsers(1, {}, StreetGrid(), 1).at(0).empty());
}

TEST(RoadUsers, PedestriansStayOnThePavements)
{
    const StreetGrid grid;
    const auto route = hard_route();
    const RoadUsers users(1, route, grid, 1);
    std::size_t pedestrians = 0;
    for (std::size_t frame = 0; frame < route.size(); frame += 7)
        for (const auto& user : users.at(frame))
        {
            if (user.kind != RoadUserKind::pedestrian) continue;
            ++pedestrians;
            EXPECT_TRUE(grid.bounds().contains({user.x, user.y}));
            const auto pitch = grid.crossing(1, 1);
            const double from_street_x = std::abs(std::remainder(user.x, pitch.x));
            const double from_street_y = std::abs(std::remainder(user.y, pitch.y));
            const double half = grid.carriageway / 2;
            const double nearest = std::min(from_street_x, from_street_y);
            EXPECT_LT(nearest, grid.street_width() / 2) << "in a house";
            const bool outside = user.x < -half || user.y < -half ||
                                 user.x > grid.crossing(grid.columns, 0).x + half ||
                                 user.y > grid.crossing(0, grid.rows).y + half;
            EXPECT_TRUE(outside || nearest > half) << user.x << " " << user.y;
        }
    EXPECT_GT(pedestrians, 1000U);
}

TEST(RoadUsers, PedestriansWalkAtTheirPace)
{
    const auto route = hard_route();
    const RoadUsers users(0.5, route, StreetGrid(), 1);
    const auto now = users.at(20);
    const auto next = users.at(21);
    int walking = 0;
    for (const auto& a : now)
        for (const auto& b : next)
        {
            if (a.kind != RoadUserKind::pedestrian || a.seed != b.seed) continue;
            const double metres = std::hypot(b.x - a.x, b.y - a.y);
            EXPECT_LT(metres, 0.81);  // half a second at 1.6 m/s
            EXPECT_EQ(metres > 1e-9, a.stride != b.stride);
            walking += metres > 0.4 ? 1 : 0;
        }
    EXPECT_GT(walking, 10);
}

TEST(RoadUsers, VehiclesKeepClearOfTheRobotAndOfEachOther)
{
    for (const std::uint64_t seed : {1U, 2U, 3U})
    {
        const auto route = hard_route(seed);
        const RoadUsers users(1, route, StreetGrid(), seed);
        for (std::size_t frame = 0; frame < route.size(); ++frame)
        {
            const auto all = vehicles(users.at(frame));
            const auto& robot = route[frame].map_from_robot;
            for (std::size_t i = 0; i < all.size(); ++i)
            {
                EXPECT_FALSE(covers(all[i], robot.x, robot.y, 0.8)) << seed << " " << frame;
                for (std::size_t j = 0; j < i; ++j)
                    EXPECT_FALSE(overlap(all[i], all[j])) << seed << " " << frame;
            }
        }
    }
}

TEST(RoadUsers, VehiclesLeaveParkedCarsAlone)
{
    const auto plan = fild::plan_town(options_of(Preset::hard).town);
    const auto route = hard_route();
    const RoadUsers users(1, route, plan.grid, 1);
    for (std::size_t frame = 0; frame < route.size(); ++frame)
        for (const auto& vehicle : vehicles(users.at(frame)))
            for (const auto& bay : plan.parking_bays)
            {
                const RoadUser parked{
                    RoadUserKind::car, bay.at.x, bay.at.y, bay.heading, 0, bay.seed};
                EXPECT_FALSE(overlap(vehicle, parked)) << frame << " " << vehicle.x;
            }
}

TEST(RoadUsers, SomeVehiclesComeCloseInEachLap)
{
    const auto options = options_of(Preset::hard);
    const auto route = hard_route();
    const RoadUsers users(options.conditions.occluders, route, StreetGrid(), 1);
    std::vector<int> close(2);
    std::vector<int> ahead(2);
    for (std::size_t frame = 0; frame < route.size(); ++frame)
        for (const auto& vehicle : vehicles(users.at(frame)))
        {
            const auto& robot = route[frame].map_from_robot;
            const double metres = std::hypot(vehicle.x - robot.x, vehicle.y - robot.y);
            const auto lap = static_cast<std::size_t>(route[frame].lap);
            close[lap] += metres < 8 ? 1 : 0;
            const auto seen = seen_from(
                {RoadUserKind::car, robot.x, robot.y, robot.yaw, 0, 0}, vehicle.x, vehicle.y);
            ahead[lap] += metres < 8 && seen.x > 5 && std::abs(seen.y) < 3 ? 1 : 0;
        }
    for (const std::size_t lap : {0U, 1U})
    {
        EXPECT_GT(close[lap], 10) << lap;
        EXPECT_GT(ahead[lap], 3) << lap;
    }
}

TEST(RoadUsers, DependOnTheSeedAlone)
{
    const auto route = hard_route();
    const RoadUsers once(0.5, route, StreetGrid(), 1);
    const RoadUsers again(0.5, route, StreetGrid(), 1);
    const RoadUsers other(0.5, route, StreetGrid(), 2);
    const auto a = once.at(50);
    const auto b = again.at(50);
    const auto c = other.at(50);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        EXPECT_EQ(a[i].x, b[i].x);
        EXPECT_EQ(a[i].seed, b[i].seed);
    }
    ASSERT_FALSE(c.empty());
    EXPECT_NE(a.back().seed, c.back().seed);
}

TEST(RoadUsers, DifferFromLapToLap)
{
    const auto route = hard_route();
    const RoadUsers users(1, route, StreetGrid(), 1);
    const auto second = std::find_if(
        route.begin(), route.end(), [](const RoutePose& pose) { return pose.lap == 1; });
    const auto frame = static_cast<std::size_t>(second - route.begin());
    for (const auto& before : users.at(frame - 1))
        for (const auto& after : users.at(frame))
            EXPECT_FALSE(before.kind == RoadUserKind::pedestrian && before.seed == after.seed);
}

}  // namespace
