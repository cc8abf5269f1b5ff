// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/birds_eye.h"

#include <mrpt/poses/CPose3D.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fild
{
namespace
{
constexpr double kFlightAngle = 0.55;  // rad off the vertical
const cv::Scalar kStartColour(178, 114, 0);
const cv::Scalar kEndColour(0, 94, 213);

/** A camera in the air that has all of the town in its picture. */
class AirView
{
 public:
    /** \param quarter_turns  of the picture's upward direction, from the y axis to the left. */
    AirView(const StreetGrid& grid, int width, int quarter_turns);

    const CameraModel& camera() const { return camera_; }
    const mrpt::poses::CPose3D& map_from_camera() const { return map_from_camera_; }
    cv::Point2d project(const cv::Point3d& in_map) const;

 private:
    CameraModel camera_;
    mrpt::poses::CPose3D map_from_camera_;
};

AirView::AirView(const StreetGrid& grid, int width, int quarter_turns)
{
    const auto all = grid.bounds();
    constexpr double kHouses = 12;  // around the streets
    auto half_width = all.width / 2 + kHouses;
    auto half_height = all.height / 2 + kHouses;
    if (quarter_turns % 2 != 0) std::swap(half_width, half_height);
    const auto yaw = quarter_turns * CV_PI / 2;
    const auto distance = 2.2 * std::max(half_width, half_height);
    camera_.width = width;
    // The nearest row of houses is the widest in the picture.
    const auto nearest = distance - half_height * std::sin(kFlightAngle);
    camera_.fx = camera_.fy = 0.98 * nearest * width / 2 / half_width;
    const auto tilted = 2 * half_height * std::cos(kFlightAngle) * camera_.fy / distance;
    camera_.height = cvRound(1.22 * tilted);
    camera_.cx = (camera_.width - 1) / 2.0;
    camera_.cy = camera_.height * 0.46;
    const cv::Point2d middle(all.x + all.width / 2, all.y + all.height / 2);
    const auto behind = distance * std::sin(kFlightAngle);
    map_from_camera_ = mrpt::poses::CPose3D(middle.x + behind * std::sin(yaw),
                                            middle.y - behind * std::cos(yaw),
                                            distance * std::cos(kFlightAngle),
                                            yaw,
                                            0,
                                            -CV_PI + kFlightAngle);
}

cv::Point2d AirView::project(const cv::Point3d& in_map) const
{
    double x = 0;
    double y = 0;
    double z = 0;
    map_from_camera_.inverseComposePoint(in_map.x, in_map.y, in_map.z, x, y, z);
    return {camera_.fx * x / z + camera_.cx, camera_.fy * y / z + camera_.cy};
}

cv::Scalar route_colour(std::size_t index)
{
    static const std::vector<cv::Scalar> colours{{40, 40, 230},
                                                 {235, 200, 30},
                                                 {30, 200, 250},
                                                 {230, 60, 200},
                                                 {60, 220, 60},
                                                 {250, 140, 90}};
    return colours[index % colours.size()];
}

/** \param index  which colour. \param layer  0: on top of all; lines below are wider, so that they
 *  show where others lie on them. */
void draw_route(cv::Mat& picture,
                const AirView& view,
                const RouteLine& route,
                std::size_t index,
                std::size_t layer)
{
    constexpr double kArrowEvery = 50;
    const auto thickness = std::max(2, picture.cols / 500) * (2 + static_cast<int>(layer)) / 2;
    double driven = kArrowEvery / 2;
    for (std::size_t i = 1; i < route.points.size(); ++i)
    {
        const auto from = view.project(route.points[i - 1]);
        const auto to = view.project(route.points[i]);
        cv::line(picture, from, to, route_colour(index), thickness, cv::LINE_AA);
        driven += cv::norm(route.points[i] - route.points[i - 1]);
        if (driven < kArrowEvery) continue;
        driven = 0;
        const auto length = std::max(1e-6, cv::norm(to - from));
        const auto tip = to + (to - from) * (5.0 * thickness / length);
        cv::arrowedLine(picture, to, tip, route_colour(index), thickness, cv::LINE_AA, 0, 0.7);
    }
}

/** Where the drive begins and ends, as on map_top.png. */
void draw_ends(cv::Mat& picture, const AirView& view, const std::vector<RouteLine>& routes)
{
    const auto unit = picture.cols / 800.0;
    const auto mark = [&](const cv::Point3d& place, bool is_start)
    {
        const cv::Point at(view.project(place));
        const auto size = cvRound(5 * unit);
        const auto& colour = is_start ? kStartColour : kEndColour;
        const auto draw = [&](int radius, const cv::Scalar& fill)
        {
            const cv::Point corner(radius, radius);
            if (is_start)
                cv::circle(picture, at, radius, fill, cv::FILLED, cv::LINE_AA);
            else
                cv::rectangle(picture, at - corner, at + corner, fill, cv::FILLED);
        };
        draw(size + cvRound(1.5 * unit), cv::Scalar::all(255));
        draw(size, colour);
        for (const auto& [ink, stroke] :
             {std::pair{cv::Scalar::all(255), 4 * unit}, std::pair{colour, 1.2 * unit}})
            cv::putText(picture,
                        is_start ? "start" : "end",
                        at + cv::Point(cvRound((is_start ? 9 : -34) * unit), cvRound(4 * unit)),
                        cv::FONT_HERSHEY_SIMPLEX,
                        0.45 * unit,
                        ink,
                        cvRound(stroke),
                        cv::LINE_AA);
    };
    mark(routes.back().points.back(), false);
    mark(routes.front().points.front(), true);
}

/** So that the picture is the same way up as a map whose x axis is the heading at the start. */
int quarter_turns_of(const std::vector<RouteLine>& routes)
{
    if (routes.empty() || routes.front().points.size() < 2) return 0;
    const auto way = routes.front().points[1] - routes.front().points[0];
    return cvRound(std::atan2(way.y, way.x) / (CV_PI / 2));
}

void draw_legend(cv::Mat& picture, const std::vector<std::string>& names)
{
    const auto unit = picture.cols / 800.0;
    const auto row = cvRound(16 * unit);
    const cv::Rect box(cvRound(8 * unit),
                       cvRound(8 * unit),
                       cvRound(150 * unit),
                       static_cast<int>(names.size()) * row + cvRound(6 * unit));
    auto panel = picture(box & cv::Rect({0, 0}, picture.size()));
    panel = panel * 0.35;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        const auto y = box.y + static_cast<int>(i) * row + cvRound(11 * unit);
        const auto x = box.x + cvRound(6 * unit);
        const auto thickness = cvRound(3 * unit);
        cv::line(
            picture, {x, y}, {x + cvRound(20 * unit), y}, route_colour(i), thickness, cv::LINE_AA);
        cv::putText(picture,
                    names[i],
                    {x + cvRound(26 * unit), y + cvRound(4 * unit)},
                    cv::FONT_HERSHEY_SIMPLEX,
                    0.4 * unit,
                    {245, 245, 245},
                    std::max(1, cvRound(0.7 * unit)),
                    cv::LINE_AA);
    }
}

std::string name_of_part(const RoutePose& pose)
{
    switch (pose.stretch)
    {
        case Stretch::once:
            return "driven once";
        case Stretch::opposite:
            return "opposite direction";
        case Stretch::link:
            return "connecting road";
        case Stretch::lap:
            break;
    }
    return "lap " + std::to_string(pose.lap + 1);
}

/** The names of the lines, each once, in order. */
std::vector<std::string> names_of(const std::vector<RouteLine>& routes)
{
    std::vector<std::string> names;
    for (const auto& route : routes)
        if (std::find(names.begin(), names.end(), route.name) == names.end())
            names.push_back(route.name);
    return names;
}
}  // namespace

std::vector<RouteLine> route_lines(const std::vector<RoutePose>& route)
{
    std::vector<RouteLine> lines;
    for (const auto& pose : route)
    {
        const auto name = name_of_part(pose);
        if (lines.empty() || lines.back().name != name)
        {
            RouteLine line{name, {}};
            if (!lines.empty()) line.points.push_back(lines.back().points.back());
            lines.push_back(std::move(line));
        }
        const auto& at = pose.map_from_robot;
        lines.back().points.emplace_back(at.x, at.y, at.z);
    }
    return lines;
}

cv::Mat draw_birds_eye(Town& town,
                       const std::vector<RouteLine>& routes,
                       const LapConditions& conditions,
                       int width)
{
    const AirView view(town.grid(), width, quarter_turns_of(routes));
    auto picture = town.draw(view.camera(), view.map_from_camera(), conditions).image;
    const auto names = names_of(routes);
    for (const auto& route : routes)
    {
        const auto name = std::find(names.begin(), names.end(), route.name);
        const auto index = static_cast<std::size_t>(name - names.begin());
        draw_route(picture, view, route, index, names.size() - 1 - index);
    }
    if (!routes.empty()) draw_ends(picture, view, routes);
    draw_legend(picture, names);
    return picture;
}

}  // namespace fild
