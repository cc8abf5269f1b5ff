// SPDX-License-Identifier: BSD-3-Clause
#include "rectification.h"

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
bool stands_beside(const RigidTransform& left_from_right)
{
    const auto& baseline = left_from_right.translation;
    return std::abs(baseline[0]) >= std::abs(baseline[1]);
}

/** From the left camera's axes to those of both views. */
cv::Matx33d view_from_left(const RigidTransform& left_from_right)
{
    const auto& right = left_from_right.rotation;
    const cv::Vec3d between(right(0, 2), right(1, 2), right(2, 2) + 1);
    const bool is_beside = stands_beside(left_from_right);
    auto along = cv::normalize(left_from_right.translation);
    if (along[is_beside ? 0 : 1] < 0) along = -along;
    const auto across = cv::normalize(is_beside ? between.cross(along) : along.cross(between));
    const auto& x = is_beside ? along : across;
    const auto& y = is_beside ? across : along;
    const auto z = x.cross(y);
    return {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
}

bool is_turned(const cv::Matx33d& rotation, const CameraModel& camera)
{
    constexpr double kNegligible = 0.02;  // pixels
    return cv::norm(vector_from_rotation(rotation)) * std::max(camera.fx, camera.fy) > kNegligible;
}

/** Equal focal lengths, and the middle of the image in the middle. */
CameraModel centred_camera(const CameraModel& camera, const cv::Matx33d& view_from_camera)
{
    auto view = without_distortion(camera);
    view.fx = view.fy = std::sqrt(camera.fx * camera.fy);
    const double x = (camera.width - 1) / 2.0;
    const double y = (camera.height - 1) / 2.0;
    const auto middle =
        view_from_camera * cv::Vec3d((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
    view.cx = x - view.fx * middle[0] / middle[2];
    view.cy = y - view.fy * middle[1] / middle[2];
    return view;
}

bool have_equal_rows(const CameraModel& a, const CameraModel& b)
{
    return a.fx == b.fx && a.fy == b.fy && a.cy == b.cy;
}

bool have_equal_columns(const CameraModel& a, const CameraModel& b)
{
    return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx;
}
}  // namespace

PinholeView rectified_left(const CameraModel& left, const RigidTransform& left_from_right)
{
    const auto rotation = view_from_left(left_from_right);
    if (is_turned(rotation, left) || is_turned(rotation * left_from_right.rotation, left))
        return {rotation, centred_camera(left, rotation)};
    if (!has_distortion(left)) return straight_view(left);
    return {cv::Matx33d::eye(), centred_camera(left, cv::Matx33d::eye())};
}

Rectification rectify(const CameraModel& left,
                      const CameraModel& right,
                      const RigidTransform& left_from_right)
{
    const auto left_view = rectified_left(left, left_from_right);
    const auto& rotation = left_view.view_from_camera;
    if (rotation != cv::Matx33d::eye())
        return {left_view,
                {rotation * left_from_right.rotation, left_view.camera},
                {cv::Matx33d::eye(), rotation * left_from_right.translation}};
    const bool is_rectified = stands_beside(left_from_right)
                                  ? have_equal_rows(left_view.camera, right)
                                  : have_equal_columns(left_view.camera, right);
    if (is_rectified && !has_distortion(right))
        return {left_view, straight_view(right), left_from_right};
    return {left_view, {cv::Matx33d::eye(), left_view.camera}, left_from_right};
}

}  // namespace fild
