// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/route.h"

#include "fild/core/angle.h"
#include "lane_path.h"
#include "seeded_generator.h"
#include "smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
constexpr double kLaneCentre = 1.5;  // m right of the street's centre line
constexpr double kCornerReach = 9;  // m from the crossing of two lanes to where a corner begins
constexpr double kLateralAcceleration = 2;  // m/s^2 in corners: a calm driver's
constexpr double kLaneChange = 25;  // m
/** From the circuit to the stretch that is driven once: its 20 m, and offsets from the lane. */
constexpr double kFarFromCircuit = 22.5;

/** Where the middle lines of the right-hand lanes of two streets cross, for a left turn there.
 *  \param ahead  direction of travel before the turn, a unit vector. */
cv::Point2d left_turn_vertex(cv::Point2d crossing, cv::Point2d ahead)
{
    const cv::Point2d left(-ahead.y, ahead.x);
    return crossing + kLaneCentre * (ahead - left);
}

/** The path, and at which way along it what begins. */
struct Course
{
    LanePath path;
    std::vector<double> lap_begins;
    /** Parts after the laps, in order. */
    std::vector<std::pair<double, Stretch>> later_stretches;
};

std::vector<cv::Point2d> course_vertices(const TRouteOptions& options, const StreetGrid& grid)
{
    const int right = options.circuit_columns;
    const int far = options.circuit_rows;
    const int back = right - options.opposite_blocks;
    const cv::Point2d east(1, 0);
    const cv::Point2d north(0, 1);
    const auto far_right = left_turn_vertex(grid.crossing(right, far), north);

    std::vector<cv::Point2d> vertices{far_right - kCornerReach * east};
    for (int lap = 0; lap < options.laps; ++lap)
    {
        vertices.push_back(left_turn_vertex(grid.crossing(0, far), -east));
        vertices.push_back(left_turn_vertex(grid.crossing(0, 0), -north));
        vertices.push_back(left_turn_vertex(grid.crossing(right, 0), east));
        if (lap + 1 < options.laps) vertices.push_back(far_right);
    }
    vertices.push_back(left_turn_vertex(grid.crossing(right, far + 1), north));
    vertices.push_back(left_turn_vertex(grid.crossing(back, far + 1), -east));
    vertices.push_back(left_turn_vertex(grid.crossing(back, far), -north));
    vertices.push_back(grid.crossing(right, far) -
                       cv::Point2d(kCornerReach, kLaneCentre));  // before the crossing
    return vertices;
}

Course plan_course(const TRouteOptions& options, const StreetGrid& grid)
{
    const auto vertices = course_vertices(options, grid);
    Course course{LanePath(vertices, kCornerReach), {0}, {}};
    for (int lap = 1; lap < options.laps; ++lap)
        course.lap_begins.push_back(course.path.corner_end(4 * static_cast<std::size_t>(lap)));
    // The vertices after the laps: two on the street behind the circuit, the last corner, the end.
    const auto last_corner = vertices.size() - 2;
    const auto leaving = last_corner - 2;
    const double far_street = grid.crossing(0, options.circuit_rows).y + kLaneCentre;
    const double to_far_street = vertices[leaving].y - kCornerReach - far_street;
    const double passing_far_street = course.path.corner_begin(leaving) - to_far_street;
    const double once = passing_far_street + kFarFromCircuit;
    const double link_back =
        course.path.corner_end(last_corner - 1) + to_far_street - kFarFromCircuit;
    course.later_stretches = {{passing_far_street - kCornerReach, Stretch::link},
                              {once, Stretch::once},
                              {std::max(once, link_back), Stretch::link},
                              {course.path.corner_end(last_corner), Stretch::opposite}};
    return course;
}

double speed_at(const TRouteOptions& options, const LanePoint& point)
{
    const double curvature = std::max(std::abs(point.curvature), 1e-9);
    return std::min(options.speed_m_per_s, std::sqrt(kLateralAcceleration / curvature));
}

/** Ways along the path at which the frames are taken. */
std::vector<double> frame_ways(const TRouteOptions& options, const LanePath& path)
{
    constexpr double kStep = 0.05;  // m
    const auto wanted = static_cast<std::size_t>(options.max_frames);
    std::vector<double> ways;
    double seconds = 0;
    for (double s = 0; s < path.length(); s += kStep)
    {
        const double speed = speed_at(options, path.at(s + kStep / 2));
        const double until = seconds + kStep / speed;
        for (;;)
        {
            const double due = static_cast<double>(ways.size()) / options.frames_per_second;
            if (due >= until) break;
            ways.push_back(s + speed * (due - seconds));
            if (ways.size() == wanted) return ways;  // never when 0 are wanted, which is all
        }
        seconds = until;
    }
    return ways;
}

int lap_at(const Course& course, double s)
{
    const auto& begins = course.lap_begins;
    return static_cast<int>(std::upper_bound(begins.begin(), begins.end(), s) - begins.begin()) - 1;
}

Stretch stretch_at(const Course& course, double s)
{
    auto stretch = Stretch::lap;
    for (const auto& [begin, later] : course.later_stretches)
        if (s >= begin) stretch = later;
    return stretch;
}
/** How a lap is driven at one place, apart from all that is drawn by lot. */
struct LapManner
{
    double left_m = 0;  ///< beside the middle of the right-hand lane
    double left_per_metre = 0;  ///< its derivative by the way
    double view = 0;  ///< rad, of the robot's heading to the left of the way
};

/** From 0 to 1 as `u` goes from 0 to 1, with level ends. */
double smooth_step(double u)
{
    u = std::clamp(u, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

/** The laps with an odd number are driven aside and with the view turned. */
LapManner lap_manner(const TRouteOptions& options, const Course& course, double s)
{
    const auto lap = static_cast<std::size_t>(lap_at(course, s));
    const double begin = course.lap_begins[lap];
    const double end = lap + 1 < course.lap_begins.size() ? course.lap_begins[lap + 1]
                                                          : course.later_stretches.front().first;
    if (lap % 2 == 0 || s >= end) return {};
    const auto left = [&](double way)
    {
        const double from_end = std::min(way - begin, end - way);
        return options.lap_offset_m * smooth_step(from_end / kLaneChange);
    };
    constexpr double kStep = 0.01;  // m
    const double wave = std::sin(2 * 180 * kRadiansPerDegree * (s - begin) / (end - begin));
    // Over 85 % of the full angle for half of the lap.
    const double turned = wave * (1.5 - 0.5 * wave * wave);
    return {left(s),
            (left(s + kStep) - left(s - kStep)) / (2 * kStep),
            options.lap_view_deg * kRadiansPerDegree * turned};
}

/** How the robot deviates from the path: smooth curves over the way. */
class Deviation
{
 public:
    Deviation(const TRouteOptions& options, double length, std::uint64_t seed)
        : options_(options),
          offset_(length, 20, seeded_generator(seed, RandomPurpose::lane_offset, 0)),
          heading_(length, 15, seeded_generator(seed, RandomPurpose::heading, 0)),
          roll_(length, 5, seeded_generator(seed, RandomPurpose::suspension, 0)),
          pitch_(length, 5, seeded_generator(seed, RandomPurpose::suspension, 1))
    {
    }

    mrpt::math::TPose3D pose(const LanePoint& lane, const LapManner& manner, double s) const
    {
        const double offset = manner.left_m + options_.lane_offset_m * offset_.value(s);
        const double sideways =
            std::atan2(manner.left_per_metre + options_.lane_offset_m * offset_.derivative(s),
                       1 - lane.curvature * offset);
        const cv::Point2d left(-std::sin(lane.heading), std::cos(lane.heading));
        const auto position = lane.position + offset * left;
        const double heading = lane.heading + sideways + manner.view +
                               options_.heading_noise_deg * kRadiansPerDegree * heading_.value(s);
        const double suspension = options_.suspension_deg * kRadiansPerDegree;
        return {position.x,
                position.y,
                0,
                std::remainder(heading, 360 * kRadiansPerDegree),
                suspension * pitch_.value(s),
                suspension * roll_.value(s)};
    }

 private:
    TRouteOptions options_;
    SmoothNoise offset_;
    SmoothNoise heading_;
    SmoothNoise roll_;
    SmoothNoise pitch_;
};

}  // namespace

void TRouteOptions::describe(OptionVisitor& visitor)
{
    visitor.integer("laps", laps, 2, 1000);
    visitor.integer("circuit_columns", circuit_columns, 1, 100);
    visitor.integer("circuit_rows", circuit_rows, 1, 100);
    visitor.integer("opposite_blocks", opposite_blocks, 1, 100);
    visitor.real("speed_m_per_s", speed_m_per_s, 0.1, 50);
    visitor.real("frames_per_second", frames_per_second, 0.1, 100);
    // At three and a half standard deviations the robot must still be in its lane.
    visitor.real("lane_offset_m", lane_offset_m, 0, 0.3);
    // At 3 m it is the middle of the other lane, with the same room to the parked cars.
    visitor.real("lap_offset_m", lap_offset_m, 0, 3);
    visitor.real("lap_view_deg", lap_view_deg, 0, 45);
    visitor.real("heading_noise_deg", heading_noise_deg, 0, 10);
    visitor.real("suspension_deg", suspension_deg, 0, 3);
    visitor.integer("max_frames", max_frames, 0, 10000000);
}

void TRouteOptions::check_fits(const StreetGrid& grid) const
{
    const auto refuse = [](const std::string& what, int value, int most)
    {
        throw std::invalid_argument("[route] " + what + "=" + std::to_string(value) +
                                    " is more than the town has room for; at most " +
                                    std::to_string(most));
    };
    if (circuit_columns > grid.columns) refuse("circuit_columns", circuit_columns, grid.columns);
    if (circuit_rows >= grid.rows) refuse("circuit_rows", circuit_rows, grid.rows - 1);
    if (opposite_blocks > circuit_columns)
        refuse("opposite_blocks", opposite_blocks, circuit_columns);
}

std::vector<RoutePose> plan_route(const TRouteOptions& options,
                                  const StreetGrid& grid,
                                  std::uint64_t seed)
{
    options.check();
    options.check_fits(grid);
    const auto course = plan_course(options, grid);
    const Deviation deviation(options, course.path.length(), seed);
    std::vector<RoutePose> route;
    for (const double s : frame_ways(options, course.path))
    {
        const double seconds = static_cast<double>(route.size()) / options.frames_per_second;
        const auto lane = course.path.at(s);
        const auto manner = lap_manner(options, course, s);
        route.push_back({seconds,
                         lap_at(course, s),
                         stretch_at(course, s),
                         deviation.pose(lane, manner, s),
                         {lane.position.x, lane.position.y, lane.heading},
                         s,
                         manner.left_m});
    }
    return route;
}

double driven_metres(const std::vector<RoutePose>& route)
{
    double metres = 0;
    for (std::size_t i = 1; i < route.size(); ++i)
    {
        const auto& a = route[i - 1].map_from_robot;
        const auto& b = route[i].map_from_robot;
        metres += std::hypot(b.x - a.x, b.y - a.y);
    }
    return metres;
}

}  // namespace fild
