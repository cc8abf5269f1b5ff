// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/descriptors.h"

#include <opencv2/core/matx.hpp>

namespace fild
{
inline cv::Matx33d camera_matrix(const CameraModel& camera)
{
    return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

/** The point of the ray through a pixel at depth 1. */
inline cv::Vec3d ray_through(const CameraModel& camera, const PixelPosition& pixel)
{
    return {(static_cast<double>(pixel.x) - camera.cx) / camera.fx,
            (static_cast<double>(pixel.y) - camera.cy) / camera.fy,
            1};
}

/** Pixel of a point in the camera's frame, whose z is not 0. */
inline cv::Vec2d projected(const CameraModel& camera, const cv::Vec3d& point)
{
    return {camera.fx * point[0] / point[2] + camera.cx,
            camera.fy * point[1] / point[2] + camera.cy};
}

inline cv::Vec2d to_vector(const PixelPosition& pixel)
{
    return {static_cast<double>(pixel.x), static_cast<double>(pixel.y)};
}

}  // namespace fild
