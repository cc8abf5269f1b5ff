// SPDX-License-Identifier: BSD-3-Clause
#include "depth_registration.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
cv::Vec3d ray_of(const CameraModel& camera, int column, int row)
{
    return {(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1};
}

/** Draws a square with its centre at (x, y) and the given half side, pixels, where nothing nearer
 *  is drawn. */
void draw_nearest(cv::Mat& depth, double x, double y, double half_side, float metres)
{
    const int left = std::max(0, static_cast<int>(std::lround(x - half_side)));
    const int top = std::max(0, static_cast<int>(std::lround(y - half_side)));
    const int right = std::min(depth.cols - 1, static_cast<int>(std::lround(x + half_side)));
    const int bottom = std::min(depth.rows - 1, static_cast<int>(std::lround(y + half_side)));
    for (int row = top; row <= bottom; ++row)
        for (int column = left; column <= right; ++column)
        {
            auto& drawn = depth.at<float>(row, column);
            if (!(drawn > 0) || metres < drawn) drawn = metres;
        }
}
}  // namespace

cv::Mat depth_from_ranges(const cv::Mat& ranges, const CameraModel& camera)
{
    cv::Mat depth(ranges.size(), CV_32FC1);
    for (int row = 0; row < ranges.rows; ++row)
        for (int column = 0; column < ranges.cols; ++column)
            depth.at<float>(row, column) =
                static_cast<float>(static_cast<double>(ranges.at<float>(row, column)) /
                                   cv::norm(ray_of(camera, column, row)));
    return depth;
}

cv::Mat registered_depth(const cv::Mat& depth,
                         const CameraModel& depth_camera,
                         const CameraModel& image_camera,
                         const RigidTransform& image_from_depth)
{
    constexpr double kLargestHalfSide = 4;  // pixels; a reading before the lens fills no image
    cv::Mat registered(image_camera.height, image_camera.width, CV_32FC1, cv::Scalar(0));
    const double magnification = image_camera.fx / depth_camera.fx;
    for (int row = 0; row < depth.rows; ++row)
        for (int column = 0; column < depth.cols; ++column)
        {
            const auto metres = static_cast<double>(depth.at<float>(row, column));
            if (!(metres > 0)) continue;
            const auto point = image_from_depth * (metres * ray_of(depth_camera, column, row));
            if (!(point[2] > 0)) continue;
            const double x = image_camera.fx * point[0] / point[2] + image_camera.cx;
            const double y = image_camera.fy * point[1] / point[2] + image_camera.cy;
            if (x < -1 || y < -1 || x > image_camera.width || y > image_camera.height) continue;
            // Half a pixel less than the whole: lround() takes in the pixel it lands on.
            const double half_side = 0.5 * magnification * metres / point[2] - 0.25;
            draw_nearest(registered,
                         x,
                         y,
                         std::clamp(half_side, 0.0, kLargestHalfSide),
                         static_cast<float>(point[2]));
        }
    return registered;
}

}  // namespace fild
