// SPDX-License-Identifier: BSD-3-Clause
#include "pose_residual.h"

#include "pinhole.h"

namespace fild
{
namespace
{
/** The point of `from` projected into the camera of `to`. */
struct Projection
{
    const MeasuredPoint& from;
    const CameraModel& from_camera;
    const MeasuredPoint& to;
    const CameraModel& to_camera;
};

/** Derivatives of (pixel x, pixel y, inverse depth) by the point in the camera's frame. */
cv::Matx33d derivative_by_point(const CameraModel& camera, const cv::Vec3d& p)
{
    const double i = 1 / p[2];
    return {camera.fx * i,
            0,
            -camera.fx * p[0] * i * i,
            0,
            camera.fy * i,
            -camera.fy * p[1] * i * i,
            0,
            0,
            -i * i};
}

/** Without the parts that depend on the parametrisation: jacobian is by the point in `to`. */
struct PointResidual
{
    cv::Vec3d point;  ///< in the camera `to`
    cv::Matx33d by_point;
    PoseResidual residual;
};

std::optional<PointResidual> project(const Projection& projection, const RigidTransform& to_from)
{
    const auto& [from, from_camera, to, to_camera] = projection;
    PointResidual result;
    const auto ray = ray_through(from_camera, from.pixel);
    const double depth = 1 / from.inverse_depth;
    result.point = to_from * (depth * ray);
    constexpr double kNearest = 1e-3;  // metres before the camera
    if (!(result.point[2] > kNearest)) return std::nullopt;
    auto by_point = derivative_by_point(to_camera, result.point);
    auto& residual = result.residual;
    residual.has_depth_equation = to.has_depth();
    const auto expected = projected(to_camera, result.point);
    const auto seen = to_vector(to.pixel);
    residual.value = {seen[0] - expected[0], seen[1] - expected[1], 0};
    if (to.has_depth())
        residual.value[2] = to.inverse_depth - 1 / result.point[2];
    else
        by_point(2, 0) = by_point(2, 1) = by_point(2, 2) = 0;
    result.by_point = -by_point;

    const cv::Matx33d by_rotated = by_point * to_from.rotation;
    const cv::Vec3d by_x = by_rotated * cv::Vec3d(depth / from_camera.fx, 0, 0);
    const cv::Vec3d by_y = by_rotated * cv::Vec3d(0, depth / from_camera.fy, 0);
    const cv::Vec3d by_inverse_depth = by_rotated * (-depth * depth * ray);
    residual.pixel_part = by_x * by_x.t() + by_y * by_y.t() + cv::Matx33d::diag({1, 1, 0});
    residual.depth_part = (from.inverse_depth_deviation * from.inverse_depth_deviation) *
                          (by_inverse_depth * by_inverse_depth.t());
    if (to.has_depth())
        residual.depth_part(2, 2) += to.inverse_depth_deviation * to.inverse_depth_deviation;
    else
        residual.pixel_part(2, 2) = 1;  // an equation 0 = 0, of any weight
    return result;
}

cv::Matx<double, 3, 6> side_by_side(const cv::Matx33d& left, const cv::Matx33d& right)
{
    cv::Matx<double, 3, 6> both;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
        {
            both(row, column) = left(row, column);
            both(row, column + 3) = right(row, column);
        }
    return both;
}
}  // namespace

std::optional<PoseResidual> pose_residual(const MeasuredMatch& match,
                                          const PinholePair& cameras,
                                          const RigidTransform& candidate_from_query)
{
    const auto& [query, candidate] = match;
    const auto& rotation = candidate_from_query.rotation;
    if (candidate.has_depth())
    {
        auto in_query = project({candidate, cameras.candidate, query, cameras.query},
                                candidate_from_query.inverse());
        if (!in_query) return std::nullopt;
        // exp(-w) R^T (p - t - dt), so the point moves by -R^T dt and by itself x w.
        in_query->residual.jacobian = side_by_side(
            in_query->by_point * -rotation.t(), in_query->by_point * cross_matrix(in_query->point));
        return in_query->residual;
    }
    auto in_candidate =
        project({query, cameras.query, candidate, cameras.candidate}, candidate_from_query);
    if (!in_candidate) return std::nullopt;
    // R exp(w) p + t + dt, so the point moves by dt and by -R (p x w).
    const cv::Vec3d in_query = (1 / query.inverse_depth) * ray_through(cameras.query, query.pixel);
    in_candidate->residual.jacobian = side_by_side(
        in_candidate->by_point, in_candidate->by_point * -(rotation * cross_matrix(in_query)));
    return in_candidate->residual;
}

}  // namespace fild
