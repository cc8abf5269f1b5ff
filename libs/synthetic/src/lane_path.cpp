// SPDX-License-Identifier: BSD-3-Clause
#include "lane_path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
constexpr double kPi = 3.141592653589793;
constexpr double kRightAngle = kPi / 2;

/** Share of a corner's turn that is done when the share `u` of its length is. */
double turned(double u)
{
    return u - std::sin(2 * kPi * u) / (2 * kPi);
}

/** Where a corner of length 1 that begins at the origin along x has led to at share `u`, by
 *  Simpson's rule. */
cv::Point2d corner_point(double u, double turn)
{
    constexpr int kIntervals = 64;
    if (turn == 0) return {u, 0};
    cv::Point2d sum;
    for (int i = 0; i <= kIntervals; ++i)
    {
        const double weight = (i == 0 || i == kIntervals) ? 1 : (i % 2 == 1 ? 4 : 2);
        const double heading = turn * turned(u * i / kIntervals);
        sum += weight * cv::Point2d(std::cos(heading), std::sin(heading));
    }
    return sum * (u / (3 * kIntervals));
}

cv::Point2d rotated(cv::Point2d v, double angle)
{
    return {std::cos(angle) * v.x - std::sin(angle) * v.y,
            std::sin(angle) * v.x + std::cos(angle) * v.y};
}

double heading_of(cv::Point2d v)
{
    return std::atan2(v.y, v.x);
}

/** From one leg to the next: + or - a right angle. \throw std::invalid_argument. */
double right_turn_between(cv::Point2d leg, cv::Point2d next)
{
    if (std::abs(leg.dot(next)) > 1e-9 * cv::norm(leg) * cv::norm(next))
        throw std::invalid_argument("LanePath: legs do not meet at a right angle");
    return leg.cross(next) > 0 ? kRightAngle : -kRightAngle;
}
}  // namespace

LanePath::LanePath(const std::vector<cv::Point2d>& vertices, double corner_reach)
{
    if (vertices.size() < 2) throw std::invalid_argument("LanePath: less than two vertices");
    const double corner_length = corner_reach / corner_point(1, kRightAngle).x;
    double heading = heading_of(vertices[1] - vertices[0]);
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
    {
        const auto leg = vertices[i + 1] - vertices[i];
        const auto ahead = leg / cv::norm(leg);
        const bool is_last = i + 2 == vertices.size();
        const double before = i == 0 ? 0 : corner_reach;
        const double straight = cv::norm(leg) - before - (is_last ? 0 : corner_reach);
        if (!(straight > 0))
            throw std::invalid_argument("LanePath: leg " + std::to_string(i) + " of " +
                                        std::to_string(cv::norm(leg)) +
                                        " m is too short for its corners");
        add(vertices[i] + before * ahead, heading, straight, 0);
        if (is_last) break;
        const double turn = right_turn_between(leg, vertices[i + 2] - vertices[i + 1]);
        add(vertices[i + 1] - corner_reach * ahead, heading, corner_length, turn);
        heading += turn;
    }
}

void LanePath::add(cv::Point2d from, double heading, double length, double turn)
{
    pieces_.push_back({length_, length, from, heading, turn});
    length_ += length;
}

LanePoint LanePath::at(double s) const
{
    s = std::clamp(s, 0.0, length_);
    const auto next = std::upper_bound(pieces_.begin() + 1,
                                       pieces_.end(),
                                       s,
                                       [](double way, const Piece& p) { return way < p.begin; });
    const auto& piece = *(next - 1);
    const double u = (s - piece.begin) / piece.length;
    const auto way = piece.length * corner_point(u, piece.turn);
    return {piece.from + rotated(way, piece.heading),
            piece.heading + piece.turn * turned(u),
            piece.turn * (1 - std::cos(2 * kPi * u)) / piece.length};
}

}  // namespace fild
