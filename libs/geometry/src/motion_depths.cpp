// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/motion_depths.h"

#include "fild/core/angle.h"
#include "matched_pixels.h"
#include "pinhole.h"
#include "two_view_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

double angle_between(const cv::Vec3d& a, const cv::Vec3d& b)
{
    return std::atan2(cv::norm(a.cross(b)), a.dot(b));
}

/** A depth and its standard deviation, metres. */
struct Triangulated
{
    double z = 0;
    double deviation = 0;
};

/** The depth along the current frame's ray at which it falls nearest to the earlier pixel. */
std::optional<Triangulated> triangulated(const CameraModel& camera,
                                         const PixelPosition& current,
                                         const PixelPosition& earlier,
                                         const RigidTransform& earlier_from_current,
                                         const TDepthOptions& options)
{
    const cv::Vec3d ray = earlier_from_current.rotation * ray_through(camera, current);
    const auto seen = ray_through(camera, earlier);
    const auto& t = earlier_from_current.translation;
    if (angle_between(ray, seen) < options.min_parallax_deg * kRadiansPerDegree)
        return std::nullopt;
    // z (ray_x - seen_x ray_z) = seen_x t_z - t_x, and the same in y.
    const cv::Vec2d a(ray[0] - seen[0] * ray[2], ray[1] - seen[1] * ray[2]);
    const cv::Vec2d b(seen[0] * t[2] - t[0], seen[1] * t[2] - t[1]);
    const double z = a.dot(b) / a.dot(a);
    const cv::Vec3d point = z * ray + t;
    if (!(z >= options.min_depth_m) || !(point[2] > 0)) return std::nullopt;
    const auto pixel = projected(camera, point);
    if (cv::norm(pixel - to_vector(earlier)) > options.max_reprojection_px) return std::nullopt;
    const double i = 1 / point[2];  // derivative of the earlier pixel by z
    const cv::Vec2d by_z(camera.fx * i * (ray[0] - point[0] * i * ray[2]),
                         camera.fy * i * (ray[1] - point[1] * i * ray[2]));
    const double deviation = std::sqrt(2.0) * options.pixel_deviation_px / cv::norm(by_z);
    if (!(deviation <= options.max_relative_deviation * z)) return std::nullopt;
    return Triangulated{z, deviation};
}

/** The images' movement with the odometry's length, when the two agree. */
std::optional<RigidTransform> scaled(const TwoViewMotion& seen,
                                     const RigidTransform& odometry,
                                     const TDepthOptions& options)
{
    const double largest = options.max_direction_error_deg * kRadiansPerDegree;
    const auto turned = vector_from_rotation(seen.b_from_a.rotation.t() * odometry.rotation);
    if (cv::norm(turned) > largest ||
        angle_between(seen.b_from_a.translation, odometry.translation) > largest)
        return std::nullopt;
    return RigidTransform{seen.b_from_a.rotation,
                          cv::norm(odometry.translation) * seen.b_from_a.translation};
}
}  // namespace

KeypointDepths depths_from_motion(const MovedView& view,
                                  const TDepthOptions& options,
                                  std::uint64_t seed)
{
    options.check();
    const TwoViews views{view.camera,
                         query_pixels(view.matches, view.current),
                         view.camera,
                         candidate_pixels(view.matches, view.earlier)};
    if (view.camera.lens != LensModel::none)
        throw std::invalid_argument("depths_from_motion: the camera has a lens distortion");
    const double baseline = cv::norm(view.earlier_from_current.translation);
    if (!(baseline >= options.min_baseline_m) || !std::isfinite(baseline)) return {};
    const auto seen = two_view_motion(views, options.max_reprojection_px, usac_random_state(seed));
    const auto motion = seen ? scaled(*seen, view.earlier_from_current, options) : std::nullopt;
    if (!motion) return {};

    KeypointDepths depths;
    depths.source = DepthSource::motion;
    depths.metres.assign(view.current.size(), kUnknown);
    depths.deviations_m.assign(view.current.size(), kUnknown);
    depths.scale_deviation = view.scale_deviation;
    for (const auto k : seen->inliers)
        if (const auto point = triangulated(view.camera, views.a[k], views.b[k], *motion, options))
        {
            depths.metres[view.matches[k].query] = static_cast<float>(point->z);
            depths.deviations_m[view.matches[k].query] = static_cast<float>(point->deviation);
        }
    return depths;
}

}  // namespace fild
