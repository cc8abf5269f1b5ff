// SPDX-License-Identifier: BSD-3-Clause
#include "lane_traffic.h"

#include "lot.h"
#include "seeded_generator.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fild
{
namespace
{
constexpr double kBesidePeriod = 5;  // s between vehicles beside the robot, at density 1
constexpr double kAheadPeriod = 14;  // s between vehicles close before it
constexpr double kLifetime = 13;  // s before and after the encounter: then they are far away
constexpr double kOtherLane = 3;  // m, from the middle of the right-hand lane to that of the left
constexpr double kClosest = 3.5;  // m, from the robot to the rear of a vehicle before it
constexpr double kClearOfRobot = 1;  // m, from the robot's middle to the side of a vehicle

/** The middle of the right-hand lane at a distance along it; nothing beyond the route. */
std::optional<mrpt::math::TPose2D> lane_at(const std::vector<RoutePose>& route, double metres)
{
    const auto next =
        std::lower_bound(route.begin(),
                         route.end(),
                         metres,
                         [](const RoutePose& pose, double way) { return pose.lane_metres < way; });
    if (next == route.begin() || next == route.end()) return std::nullopt;
    const auto& a = *(next - 1);
    const auto& b = *next;
    const double share = (metres - a.lane_metres) / (b.lane_metres - a.lane_metres);
    const double turn = std::remainder(b.map_from_lane.phi - a.map_from_lane.phi, 2 * CV_PI);
    return mrpt::math::TPose2D{a.map_from_lane.x + share * (b.map_from_lane.x - a.map_from_lane.x),
                               a.map_from_lane.y + share * (b.map_from_lane.y - a.map_from_lane.y),
                               a.map_from_lane.phi + share * turn};
}

/** Where a vehicle is along the lane; nothing outside of its lifetime. */
std::optional<double> metres_at(const Encounter& encounter, const RoutePose& robot)
{
    const double since = robot.seconds - encounter.seconds;
    if (std::abs(since) > kLifetime) return std::nullopt;
    if (!encounter.is_ahead) return encounter.metres + encounter.speed * since;
    constexpr double kDrivesOff = 4;  // m/s
    const double gap = kClosest + kDrivesOff * (std::hypot(1, since) - 1);
    return robot.lane_metres + gap + size_of(encounter.kind).width / 2;
}

std::optional<RoadUser> user_at(const Encounter& encounter,
                                const std::vector<RoutePose>& route,
                                std::size_t frame)
{
    const auto metres = metres_at(encounter, route[frame]);
    if (!metres) return std::nullopt;
    const auto lane = lane_at(route, *metres);
    if (!lane) return std::nullopt;
    return RoadUser{encounter.kind,
                    lane->x - encounter.left * std::sin(lane->phi),
                    lane->y + encounter.left * std::cos(lane->phi),
                    lane->phi + (encounter.speed < 0 ? CV_PI : 0),
                    0,
                    encounter.seed};
}

/** Whether a point is within some distances of a vehicle's middle, along it and across. */
bool is_within(const RoadUser& vehicle, const cv::Point2d& at, double along, double across)
{
    const auto c = std::cos(vehicle.heading);
    const auto s = std::sin(vehicle.heading);
    const auto dx = at.x - vehicle.x;
    const auto dy = at.y - vehicle.y;
    return std::abs(c * dx + s * dy) < along && std::abs(c * dy - s * dx) < across;
}

bool touch(const RoadUser& a, const RoadUser& b)
{
    const auto of_a = size_of(a.kind);
    const auto of_b = size_of(b.kind);
    const auto along = (of_a.width + of_b.width) / 2 + 1;
    const auto across = (of_a.height + of_b.height) / 2 + 0.2;
    return is_within(a, {b.x, b.y}, along, across) || is_within(b, {a.x, a.y}, along, across);
}

/** Whether a vehicle keeps clear of the robot and of all others, at every frame. */
bool has_room(const Encounter& encounter,
              const std::vector<RoutePose>& route,
              const std::vector<Encounter>& others)
{
    const auto size = size_of(encounter.kind);
    for (std::size_t frame = 0; frame < route.size(); ++frame)
    {
        const auto user = user_at(encounter, route, frame);
        if (!user) continue;
        const auto& robot = route[frame].map_from_robot;
        if (is_within(
                *user, {robot.x, robot.y}, size.width / 2 + 1, size.height / 2 + kClearOfRobot))
            return false;
        for (const auto& other : others)
            if (const auto beside = user_at(other, route, frame); beside && touch(*user, *beside))
                return false;
    }
    return true;
}

RoadUserKind draw_kind(Lot& lot)
{
    if (lot.chance(0.5)) return RoadUserKind::car;
    return lot.chance(0.6) ? RoadUserKind::lorry : RoadUserKind::bus;
}

/** Oncoming in the other lane, where the robot keeps right; else slow traffic on the right. */
Encounter draw_beside(const RoutePose& robot, Lot& lot)
{
    Encounter encounter;
    encounter.kind = draw_kind(lot);
    encounter.seconds = robot.seconds;
    encounter.metres = robot.lane_metres;
    const double oncoming = lot.real(4, 8);
    const double overtaken = lot.real(0.5, 2.5);
    const bool stands = lot.chance(0.25);
    const bool keeps_right = robot.lane_left_m < kOtherLane / 2;
    encounter.left = keeps_right ? kOtherLane : 0;
    encounter.speed = keeps_right ? -oncoming : overtaken;
    if (stands) encounter.speed *= 1e-6;  // keeps the direction in which it faces
    encounter.seed = lot.seed();
    return encounter;
}

Encounter draw_ahead(const RoutePose& robot, Lot& lot)
{
    Encounter encounter;
    encounter.kind = draw_kind(lot);
    encounter.is_ahead = true;
    encounter.seconds = robot.seconds;
    encounter.metres = robot.lane_metres;
    encounter.left = robot.lane_left_m;
    encounter.seed = lot.seed();
    return encounter;
}
}  // namespace

cv::Size2d size_of(RoadUserKind kind)
{
    switch (kind)
    {
        case RoadUserKind::car:
            return {4.3, 1.8};
        case RoadUserKind::lorry:
        case RoadUserKind::bus:
            return {6.5, 2.1};
        default:
            return {0.5, 0.5};
    }
}

LaneTraffic::LaneTraffic(double density, const std::vector<RoutePose>& route, std::uint64_t seed)
    : route_(route)
{
    if (!(density > 0) || route.empty()) return;
    Lot lot(seeded_generator(seed, RandomPurpose::traffic, 0)());
    const auto frame_at = [&](double seconds)
    {
        return std::find_if(route.begin(),
                            route.end(),
                            [&](const RoutePose& pose) { return pose.seconds >= seconds; });
    };
    const auto end = route.back().seconds;
    const auto add = [&](const Encounter& encounter)
    {
        if (has_room(encounter, route_, encounters_)) encounters_.push_back(encounter);
    };
    for (double at = 3; at < end; at += kAheadPeriod / density * lot.real(0.7, 1.3))
        add(draw_ahead(*frame_at(at), lot));
    for (double at = 1; at < end; at += kBesidePeriod / density * lot.real(0.7, 1.3))
        add(draw_beside(*frame_at(at), lot));
}

std::vector<RoadUser> LaneTraffic::at(std::size_t frame) const
{
    std::vector<RoadUser> users;
    for (const auto& encounter : encounters_)
        if (const auto user = user_at(encounter, route_, frame)) users.push_back(*user);
    return users;
}

}  // namespace fild
