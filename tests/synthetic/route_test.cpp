// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/route.h"

#include "message_of.h"
#include "town_plan.h"

#include <algorithm>
#include <cmath>

namespace
{
using fild::plan_route;
using fild::RoutePose;
using fild::StreetGrid;
using fild::Stretch;
using fild::TRouteOptions;
using fild::testing::message_of;
using ::testing::HasSubstr;

constexpr double kRadPerDeg = 0.017453292519943295;

/** Frames so dense that differences are derivatives. */
TRouteOptions dense_options()
{
    TRouteOptions options;
    options.frames_per_second = 50;
    return options;
}

TRouteOptions without_noise(TRouteOptions options)
{
    options.lane_offset_m = options.heading_noise_deg = options.suspension_deg = 0;
    return options;
}

double distance(const RoutePose& a, const RoutePose& b)
{
    return std::hypot(b.map_from_robot.x - a.map_from_robot.x,
                      b.map_from_robot.y - a.map_from_robot.y);
}

double turned(const RoutePose& a, const RoutePose& b)
{
    return std::remainder(b.map_from_robot.yaw - a.map_from_robot.yaw, 360 * kRadPerDeg);
}

std::vector<RoutePose> part(const std::vector<RoutePose>& route, Stretch stretch, int lap)
{
    std::vector<RoutePose> chosen;
    for (const auto& pose : route)
        if (pose.stretch == stretch && pose.lap == lap) chosen.push_back(pose);
    return chosen;
}

/** Metres beside the middle of the nearest street; positive: to the right of the travel. */
double right_of_street_middle(const RoutePose& pose, const StreetGrid& grid)
{
    const auto& p = pose.map_from_robot;
    const auto pitch = grid.crossing(1, 1);
    const bool along_x = std::abs(std::cos(p.yaw)) > std::abs(std::sin(p.yaw));
    return along_x ? -std::remainder(p.y, pitch.y) * (std::cos(p.yaw) > 0 ? 1 : -1)
                   : std::remainder(p.x, pitch.x) * (std::sin(p.yaw) > 0 ? 1 : -1);
}

TEST(Route, TakesAFrameAtEachTick)
{
    const TRouteOptions options;
    const auto route = plan_route(options, {}, 1);
    for (std::size_t i = 0; i < route.size(); ++i)
        EXPECT_DOUBLE_EQ(route[i].seconds, static_cast<double>(i) / 2);
}

TEST(Route, DrivesAtItsSpeedAndSlowerInCorners)
{
    const auto options = without_noise(dense_options());
    const auto route = plan_route(options, {}, 1);
    double slowest = 1e9;
    for (std::size_t i = 1; i < route.size(); ++i)
    {
        const double speed = distance(route[i - 1], route[i]) * options.frames_per_second;
        EXPECT_LT(speed, options.speed_m_per_s + 1e-6);
        slowest = std::min(slowest, speed);
    }
    EXPECT_NEAR(distance(route[0], route[1]) * 50, options.speed_m_per_s, 1e-6);
    EXPECT_GT(slowest, 2.5);
    EXPECT_LT(slowest, 3.5);
}

TEST(Route, HasNoJumpsOfPositionOrHeading)
{
    for (const std::uint64_t seed : {1U, 2U, 3U})
    {
        const auto route = plan_route(dense_options(), {}, seed);
        for (std::size_t i = 2; i < route.size(); ++i)
        {
            const double way = distance(route[i - 1], route[i]);
            ASSERT_LT(way, 0.105) << i;
            ASSERT_GT(way, 0.04) << i;
            // At most one turn in 4 m, noise included.
            ASSERT_LT(std::abs(turned(route[i - 1], route[i])), way / 4) << i;
            const double change =
                turned(route[i - 1], route[i]) - turned(route[i - 2], route[i - 1]);
            ASSERT_LT(std::abs(change), 0.002) << i;
            ASSERT_LT(std::abs(route[i].map_from_robot.pitch - route[i - 1].map_from_robot.pitch),
                      0.05 * kRadPerDeg);
        }
    }
}

TEST(Route, StaysInTheRightHandLane)
{
    const StreetGrid grid;
    TRouteOptions options;
    options.lane_offset_m = 0.3;
    for (const std::uint64_t seed : {1U, 2U, 3U})
        for (const auto& pose : plan_route(options, grid, seed))
        {
            const auto pitch = grid.crossing(1, 1);
            const double from_crossing_x = std::abs(std::remainder(pose.map_from_robot.x, pitch.x));
            const double from_crossing_y = std::abs(std::remainder(pose.map_from_robot.y, pitch.y));
            const double reach = 9 + 1.5;
            if (from_crossing_x < reach && from_crossing_y < reach) continue;
            const double right = right_of_street_middle(pose, grid);
            EXPECT_GT(right, 0.3);
            EXPECT_LT(right, 2.7);
        }
}

TEST(Route, StaysOnTheCarriagewayInCorners)
{
    const StreetGrid grid;
    for (const auto& pose : plan_route(dense_options(), grid, 1))
    {
        const auto pitch = grid.crossing(1, 1);
        const double x = std::abs(std::remainder(pose.map_from_robot.x, pitch.x));
        const double y = std::abs(std::remainder(pose.map_from_robot.y, pitch.y));
        EXPECT_LT(std::min(x, y), grid.carriageway / 2 - 1);
    }
}

TEST(Route, ClosesItsCircuitCounterClockwise)
{
    const auto route = plan_route(without_noise(dense_options()), {}, 1);
    const auto first = part(route, Stretch::lap, 0);
    const auto second = part(route, Stretch::lap, 1);
    EXPECT_LT(distance(first.front(), second.front()), 0.11);
    double turn = 0;
    for (std::size_t i = 1; i < first.size(); ++i) turn += turned(first[i - 1], first[i]);
    EXPECT_NEAR(turn, 360 * kRadPerDeg, 0.01);
    for (std::size_t i = 0; i < second.size(); ++i)
        ASSERT_LT(distance(first[i], second[i]), 0.11) << i;
}

TEST(Route, DeviatesDifferentlyInEachLap)
{
    TRouteOptions options;
    options.laps = 4;
    const auto route = plan_route(options, {}, 1);
    double squares = 0;
    int count = 0;
    for (const auto& pose : part(route, Stretch::lap, 3))
    {
        double nearest = 1e9;
        for (const auto& before : part(route, Stretch::lap, 0))
            nearest = std::min(nearest, distance(pose, before));
        EXPECT_LT(nearest, 1.25 + 1.5);  // half the way between frames, and two offsets
        const double right = right_of_street_middle(pose, {});
        if (std::abs(right) > 4.5) continue;  // in a crossing
        squares += (right - 1.5) * (right - 1.5);
        ++count;
    }
    EXPECT_GT(std::sqrt(squares / count), 0.05);
}

TEST(Route, DrivesOneStretchOnceAndFarFromAllElse)
{
    for (const std::uint64_t seed : {1U, 2U, 3U})
    {
        const auto route = plan_route(TRouteOptions(), {}, seed);
        const auto once = part(route, Stretch::once, 1);
        EXPECT_GT(driven_metres(once), 100);
        for (const auto& pose : once)
            for (const auto& other : route)
                if (other.stretch == Stretch::lap || other.stretch == Stretch::opposite)
                {
                    EXPECT_GT(distance(pose, other), 20) << pose.seconds << " " << other.seconds;
                }
    }
}

TEST(Route, DrivesOneStretchAgainstTheCircuit)
{
    const auto route = plan_route(TRouteOptions(), {}, 1);
    const auto opposite = part(route, Stretch::opposite, 1);
    EXPECT_GT(driven_metres(opposite), 50);
    for (const auto& pose : opposite)
    {
        const auto nearest =
            std::min_element(route.begin(),
                             route.end(),
                             [&](const auto& a, const auto& b)
                             {
                                 const double far_a = a.lap == 0 ? distance(a, pose) : 1e9;
                                 const double far_b = b.lap == 0 ? distance(b, pose) : 1e9;
                                 return far_a < far_b;
                             });
        EXPECT_LT(distance(*nearest, pose), 5);
        EXPECT_GT(std::abs(turned(*nearest, pose)), 170 * kRadPerDeg);
    }
    EXPECT_EQ(route.back().stretch, Stretch::opposite);
}

TEST(Route, EndsAfterTheWantedFrames)
{
    TRouteOptions options;
    const auto whole = plan_route(options, {}, 1);
    options.max_frames = 10;
    const auto begin = plan_route(options, {}, 1);
    ASSERT_EQ(begin.size(), 10U);
    for (std::size_t i = 0; i < begin.size(); ++i)
        EXPECT_EQ(begin[i].map_from_robot, whole[i].map_from_robot);
    options.max_frames = 1;
    EXPECT_EQ(plan_route(options, {}, 1).size(), 1U);
    options.max_frames = 1000000;
    EXPECT_EQ(plan_route(options, {}, 1).size(), whole.size());
}

TEST(Route, DependsOnTheSeedAlone)
{
    const auto a = plan_route(TRouteOptions(), {}, 1);
    const auto b = plan_route(TRouteOptions(), {}, 1);
    const auto c = plan_route(TRouteOptions(), {}, 2);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].map_from_robot, b[i].map_from_robot);
    EXPECT_NE(a[7].map_from_robot, c[7].map_from_robot);
}

TEST(Route, DrivesEverySecondLapInTheOtherLane)
{
    const StreetGrid grid;
    auto options = without_noise(TRouteOptions());
    options.laps = 3;
    const auto usual = plan_route(options, grid, 1);
    options.lap_offset_m = 2.5;
    const auto aside = plan_route(options, grid, 1);
    ASSERT_EQ(aside.size(), usual.size());
    std::size_t in_the_other_lane = 0;
    for (std::size_t i = 0; i < aside.size(); ++i)
    {
        const auto left = distance(aside[i], usual[i]);
        EXPECT_LE(left, 2.5 + 1e-9);
        EXPECT_NEAR(left, aside[i].lane_left_m, 1e-9);
        if (aside[i].lap != 1)
        {
            EXPECT_EQ(aside[i].map_from_robot, usual[i].map_from_robot) << i;
            continue;
        }
        in_the_other_lane += left > 2.49 ? 1 : 0;
        const double right = right_of_street_middle(aside[i], grid);
        const double turn = std::remainder(aside[i].map_from_lane.phi, 90 * kRadPerDeg);
        if (std::abs(right) < 4.5 && std::abs(turn) < 1e-9 && left > 2.499)
        {
            EXPECT_NEAR(right, 1.5 - 2.5, 0.001);
        }
    }
    EXPECT_GT(in_the_other_lane, part(aside, Stretch::lap, 1).size() * 8 / 10);
}

TEST(Route, HasNoJumpsWhereItChangesTheLane)
{
    auto options = dense_options();
    options.lap_offset_m = 3;
    options.lap_view_deg = 45;
    const auto route = plan_route(options, {}, 1);
    for (std::size_t i = 1; i < route.size(); ++i)
    {
        const double way = distance(route[i - 1], route[i]);
        ASSERT_LT(way, 0.11) << i;
        ASSERT_GT(way, 0.008) << i;  // on the inner side of a corner
        ASSERT_LT(std::abs(turned(route[i - 1], route[i])), 1.5 * kRadPerDeg) << i;
    }
}

TEST(Route, DrivesThroughNoParkedCar)
{
    fild::TTownOptions town;
    const auto plan = fild::plan_town(town);
    for (const double lap_offset_m : {0.0, 1.5, 2.5, 3.0})
    {
        auto options = dense_options();
        options.frames_per_second = 10;
        options.lane_offset_m = 0.3;
        options.lap_offset_m = lap_offset_m;
        for (const auto& pose : plan_route(options, plan.grid, 1))
            for (const auto& bay : plan.parking_bays)
            {
                const auto& at = pose.map_from_robot;
                const double c = std::cos(bay.heading);
                const double s = std::sin(bay.heading);
                const double ahead = c * (at.x - bay.at.x) + s * (at.y - bay.at.y);
                const double left = c * (at.y - bay.at.y) - s * (at.x - bay.at.x);
                EXPECT_FALSE(std::abs(ahead) < 2.15 && std::abs(left) < 0.86)
                    << lap_offset_m << " at " << pose.seconds;
            }
    }
}

TEST(Route, StaysOnTheCarriagewayInTheOtherLane)
{
    const StreetGrid grid;
    auto options = dense_options();
    options.lap_offset_m = 3;
    for (const auto& pose : plan_route(options, grid, 1))
    {
        const auto pitch = grid.crossing(1, 1);
        const double x = std::abs(std::remainder(pose.map_from_robot.x, pitch.x));
        const double y = std::abs(std::remainder(pose.map_from_robot.y, pitch.y));
        EXPECT_LT(std::min(x, y), grid.carriageway / 2 - 1);
    }
}

TEST(Route, TurnsTheViewInEverySecondLap)
{
    auto options = without_noise(TRouteOptions());
    const auto usual = plan_route(options, {}, 1);
    options.lap_view_deg = 25;
    const auto turned_views = plan_route(options, {}, 1);
    ASSERT_EQ(turned_views.size(), usual.size());
    int to_the_left = 0;
    int to_the_right = 0;
    for (std::size_t i = 0; i < usual.size(); ++i)
    {
        EXPECT_EQ(distance(usual[i], turned_views[i]), 0);
        const double view = turned(usual[i], turned_views[i]) / kRadPerDeg;
        EXPECT_LE(std::abs(view), 25 + 1e-9);
        if (usual[i].lap != 1 || usual[i].stretch != Stretch::lap)
        {
            EXPECT_NEAR(view, 0, 1e-9) << i;
        }
        to_the_left += view > 20 ? 1 : 0;
        to_the_right += view < -20 ? 1 : 0;
    }
    const auto lap = static_cast<int>(part(usual, Stretch::lap, 1).size());
    EXPECT_GT(to_the_left, lap / 5);
    EXPECT_GT(to_the_right, lap / 5);
}

TEST(Route, KnowsItsLane)
{
    auto options = without_noise(TRouteOptions());
    const auto route = plan_route(options, {}, 1);
    for (std::size_t i = 0; i < route.size(); ++i)
    {
        EXPECT_EQ(route[i].map_from_lane.x, route[i].map_from_robot.x);
        EXPECT_EQ(route[i].map_from_lane.y, route[i].map_from_robot.y);
        if (i > 0)
        {
            EXPECT_GE(route[i].lane_metres - route[i - 1].lane_metres,
                      distance(route[i - 1], route[i]) - 1e-6);
        }
    }
}

TEST(Route, RefusesLapsBeyondTheOtherLane)
{
    TRouteOptions options;
    options.lap_offset_m = 3.1;
    EXPECT_THROW(plan_route(options, {}, 1), std::invalid_argument);
    options.lap_offset_m = -0.1;
    EXPECT_THROW(plan_route(options, {}, 1), std::invalid_argument);
    options.lap_offset_m = 0;
    options.lap_view_deg = 46;
    EXPECT_THROW(plan_route(options, {}, 1), std::invalid_argument);
}

TEST(Route, RefusesACircuitThatTheTownHasNoRoomFor)
{
    const auto message = [](const TRouteOptions& options, const StreetGrid& grid)
    { return message_of<std::invalid_argument>([&] { plan_route(options, grid, 1); }); };
    TRouteOptions options;
    options.circuit_columns = 4;
    EXPECT_THAT(message(options, {}), HasSubstr("circuit_columns=4"));
    options.circuit_columns = 2;
    options.circuit_rows = 2;
    EXPECT_THAT(message(options, {}), HasSubstr("circuit_rows=2"));
    options.circuit_rows = 1;
    options.opposite_blocks = 3;
    EXPECT_THAT(message(options, {}), HasSubstr("opposite_blocks=3"));
    options.opposite_blocks = 1;
    options.laps = 1;
    EXPECT_THAT(message(options, {}), HasSubstr("laps=1"));
    options.laps = 2;
    StreetGrid narrow;
    narrow.block_width = 1;
    EXPECT_THAT(message(options, narrow), HasSubstr("too short"));
}

}  // namespace
