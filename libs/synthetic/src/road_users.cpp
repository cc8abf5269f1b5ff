// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/road_users.h"

#include "lane_traffic.h"
#include "lot.h"
#include "seeded_generator.h"

#include <cmath>
#include <map>

namespace fild
{
namespace
{
constexpr double kReach = 100;  // m around the robot
constexpr double kPavementOfOne = 5;  // m for each pedestrian, at density 1

/** The line around a rectangle on which a pedestrian walks. */
class Round
{
 public:
    explicit Round(const cv::Rect2d& corners) : corners_(corners) {}

    double length() const { return 2 * (corners_.width + corners_.height); }
    /** The point `metres` along the line, counter-clockwise, and the heading there. */
    std::pair<cv::Point2d, double> at(double metres) const;

 private:
    cv::Rect2d corners_;
};

std::pair<cv::Point2d, double> Round::at(double metres) const
{
    double left = std::fmod(metres, length());
    if (left < 0) left += length();
    cv::Point2d corner = corners_.tl();
    cv::Point2d ahead(1, 0);
    for (const double side : {corners_.width, corners_.height, corners_.width, corners_.height})
    {
        if (left < side) break;
        left -= side;
        corner += side * ahead;
        ahead = {-ahead.y, ahead.x};
    }
    return {corner + left * ahead, std::atan2(ahead.y, ahead.x)};
}

/** Someone who goes round a block or round the town. */
struct Pedestrian
{
    Round round;
    double start = 0;  ///< m along the round at time 0
    double speed = 0;  ///< m/s; negative: clockwise; 0: stands
    double turned = 0;  ///< rad, of someone who stands, against the round
    std::uint64_t seed = 0;

    RoadUser at(double seconds) const
    {
        constexpr double kTwoSteps = 1.4;  // m
        const auto metres = start + speed * seconds;
        const auto [place, heading] = round.at(metres);
        const double stride = speed == 0 ? 0 : std::abs(metres) / kTwoSteps;
        return {RoadUserKind::pedestrian,
                place.x,
                place.y,
                heading + (speed < 0 ? CV_PI : 0) + turned,
                stride - std::floor(stride),
                seed};
    }
};

cv::Rect2d grown(const cv::Rect2d& rect, double metres)
{
    return {rect.x - metres, rect.y - metres, rect.width + 2 * metres, rect.height + 2 * metres};
}

/** \param fronts  house fronts around which the pavement is. \param outwards  1; -1: within them.
 */
void add_pedestrians(std::vector<Pedestrian>& all,
                     const cv::Rect2d& fronts,
                     double outwards,
                     double density,
                     Lot lot)
{
    constexpr double kAtTheFronts = 0.5;  // m; trees and lamps stand 1.9 m from them
    constexpr double kAtTheTrees = 1.4;
    const auto number = static_cast<int>(
        std::lround(density * 2 * (fronts.width + fronts.height) / kPavementOfOne));
    for (int i = 0; i < number; ++i)
    {
        const double out = lot.real(kAtTheFronts, kAtTheTrees);
        Pedestrian one{Round(grown(fronts, outwards * out))};
        one.start = lot.real(0, one.round.length());
        one.speed = lot.real(1, 1.6) * (lot.chance(0.5) ? 1 : -1);
        one.seed = lot.seed();
        const double turned = lot.real(-CV_PI, CV_PI);
        if (lot.chance(0.25))
        {
            one.speed = 0;
            one.turned = turned;
        }
        all.push_back(one);
    }
}

std::vector<Pedestrian> pedestrians(double density,
                                    const StreetGrid& grid,
                                    std::uint64_t seed,
                                    int lap)
{
    std::vector<Pedestrian> all;
    Lot lot(seeded_generator(seed, RandomPurpose::pedestrians, static_cast<std::uint64_t>(lap))());
    for (int i = 0; i < grid.columns; ++i)
        for (int j = 0; j < grid.rows; ++j)
            add_pedestrians(all, grid.block(i, j), 1, density, Lot(lot.seed()));
    add_pedestrians(all, grid.bounds(), -1, density, Lot(lot.seed()));
    return all;
}
}  // namespace

struct RoadUsers::Plan
{
    std::vector<RoutePose> route;
    std::map<int, std::vector<Pedestrian>> pedestrians_of_lap;
    LaneTraffic traffic;
};

RoadUsers::RoadUsers(double density,
                     const std::vector<RoutePose>& route,
                     const StreetGrid& grid,
                     std::uint64_t seed)
{
    auto plan = std::make_unique<Plan>();
    if (density > 0)
    {
        plan->route = route;
        for (const auto& pose : route)
            if (plan->pedestrians_of_lap.count(pose.lap) == 0)
                plan->pedestrians_of_lap[pose.lap] = pedestrians(density, grid, seed, pose.lap);
        plan->traffic = LaneTraffic(density, route, seed);
    }
    plan_ = std::move(plan);
}

RoadUsers::~RoadUsers() = default;

std::vector<RoadUser> RoadUsers::at(std::size_t frame) const
{
    if (plan_->route.empty()) return {};
    const auto& robot = plan_->route.at(frame);
    auto all = plan_->traffic.at(frame);
    for (const auto& pedestrian : plan_->pedestrians_of_lap.at(robot.lap))
        all.push_back(pedestrian.at(robot.seconds));
    std::vector<RoadUser> near;
    for (const auto& user : all)
        if (std::hypot(user.x - robot.map_from_robot.x, user.y - robot.map_from_robot.y) < kReach)
            near.push_back(user);
    return near;
}

}  // namespace fild
