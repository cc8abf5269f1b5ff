// SPDX-License-Identifier: BSD-3-Clause
#include "framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fild
{
namespace
{
/** Shifts the lens so that what is in the picture is in its middle. */
void centre(PictureView& view, const Framing& framing)
{
    const double infinity = std::numeric_limits<double>::infinity();
    cv::Point2d low(infinity, infinity);
    auto high = -low;
    for (const auto& point : framing.points)
    {
        const auto pixel = view.project(point);
        low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
        high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
    }
    const auto off = (framing.inside.tl() + framing.inside.br() - low - high) / 2;
    view.camera.cx += off.x;
    view.camera.cy += off.y;
}

/** One axis of the picture. The camera at (t, z) sees a point (p, d) at the slope
 *  (p - t) / (d - z), which must lie within [first, last]: p - last d <= t - last z and
 *  p - first d >= t - first z. */
class Slab
{
 public:
    Slab(double first, double last) : first_(first), last_(last) {}

    void add(double p, double d)
    {
        lower_ = std::max(lower_, p - last_ * d);
        upper_ = std::min(upper_, p - first_ * d);
    }

    /** The largest z from which all points are within the slopes. */
    double nearest() const { return (upper_ - lower_) / (last_ - first_); }

    /** The middle of what t may be at a z. */
    double middle(double z) const { return (lower_ + upper_ + (first_ + last_) * z) / 2; }

 private:
    double first_;
    double last_;
    double lower_ = -std::numeric_limits<double>::infinity();
    double upper_ = std::numeric_limits<double>::infinity();
};
}  // namespace

cv::Point2d PictureView::project(const cv::Vec3d& in_map) const
{
    const auto p = map_from_camera.inverse() * in_map;
    return {camera.fx * p[0] / p[2] + camera.cx, camera.fy * p[1] / p[2] + camera.cy};
}

cv::Matx33d looking_down(double heading, double pitch)
{
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    const double ahead = std::cos(pitch);
    const double down = std::sin(pitch);
    return {s, -down * c, ahead * c, -c, -down * s, ahead * s, 0, -ahead, -down};
}

PictureView framed_view(const Framing& framing)
{
    PictureView view;
    auto& camera = view.camera;
    camera.width = framing.size.width;
    camera.height = framing.size.height;
    camera.fx = camera.fy = framing.focal_px;
    camera.cx = (camera.width - 1) / 2.0;
    camera.cy = (camera.height - 1) / 2.0;

    const auto& inside = framing.inside;
    Slab across((inside.x - camera.cx) / camera.fx, (inside.br().x - camera.cx) / camera.fx);
    Slab along((inside.y - camera.cy) / camera.fy, (inside.br().y - camera.cy) / camera.fy);
    double nearest_depth = std::numeric_limits<double>::infinity();
    for (const auto& point : framing.points)
    {
        const cv::Vec3d turned = framing.map_from_camera.t() * point;
        across.add(turned[0], turned[2]);
        along.add(turned[1], turned[2]);
        nearest_depth = std::min(nearest_depth, turned[2]);
    }
    const double z =
        std::min({across.nearest(), along.nearest(), nearest_depth - framing.nearest_m});
    view.map_from_camera.rotation = framing.map_from_camera;
    view.map_from_camera.translation =
        framing.map_from_camera * cv::Vec3d(across.middle(z), along.middle(z), z);
    centre(view, framing);
    return view;
}

}  // namespace fild
