// SPDX-License-Identifier: BSD-3-Clause
#include "solids.h"

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
constexpr int kTubeSides = 8;

cv::Point3d unit(const cv::Point3d& vector)
{
    return vector / std::max(cv::norm(vector), 1e-9);
}

/** Two directions at right angles to `along` and to each other; their cross product is `along`. */
std::pair<cv::Point3d, cv::Point3d> across(const cv::Point3d& along)
{
    const bool upright = std::abs(along.z) > 0.9 * cv::norm(along);
    const auto left = unit(along.cross(upright ? cv::Point3d(1, 0, 0) : cv::Point3d(0, 0, 1)));
    return {unit(left.cross(along)), left};
}
}  // namespace

void add_post(TexturedMesh& mesh,
              const PlaceFrame& frame,
              const cv::Point2d& centre,
              const cv::Vec2d& bottom_and_top,
              double radius,
              int sides)
{
    const auto height = bottom_and_top[1] - bottom_and_top[0];
    for (int i = 0; i < sides; ++i)
    {
        const auto a = 2 * CV_PI * i / sides;
        const auto b = 2 * CV_PI * (i + 1) / sides;
        const auto corner = [&](double angle, double up) {
            return frame.at(
                centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle), up);
        };
        mesh.add_panel({corner(a, bottom_and_top[0]),
                        corner(b, bottom_and_top[0]),
                        corner(b, bottom_and_top[1]),
                        corner(a, bottom_and_top[1])},
                       {static_cast<double>(i) / sides, 0, 1.0 / sides, height / 3});
    }
}

void add_tube(TexturedMesh& mesh, const std::vector<Ring>& rings, const cv::Rect2d& part)
{
    const auto outward = [&](std::size_t ring, int side)
    {
        const double azimuth = CV_PI * (2.0 * side / kTubeSides - 1);
        return std::cos(azimuth) * rings[ring].ahead + std::sin(azimuth) * rings[ring].left;
    };
    const auto corner = [&](std::size_t ring, int side)
    {
        const auto up = static_cast<double>(ring) / static_cast<double>(rings.size() - 1);
        return Corner{rings[ring].centre + outward(ring, side),
                      {part.x + part.width * side / kTubeSides, part.y + part.height * (1 - up)}};
    };
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring)
        for (int side = 0; side < kTubeSides; ++side)
        {
            const auto next = ring + 1;
            mesh.add_smooth_triangle(
                {corner(ring, side), corner(ring, side + 1), corner(next, side + 1)},
                {outward(ring, side), outward(ring, side + 1), outward(next, side + 1)});
            mesh.add_smooth_triangle(
                {corner(ring, side), corner(next, side + 1), corner(next, side)},
                {outward(ring, side), outward(next, side + 1), outward(next, side)});
        }
}

void add_limb(TexturedMesh& mesh, const std::vector<LimbPoint>& points, const cv::Rect2d& part)
{
    const auto [ahead, left] = across(points.back().at - points.front().at);
    std::vector<Ring> rings;
    rings.reserve(points.size());
    for (const auto& point : points)
        rings.push_back({point.at, point.radius * ahead, point.radius * left});
    add_tube(mesh, rings, part);
}

}  // namespace fild
