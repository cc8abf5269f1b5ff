// SPDX-License-Identifier: BSD-3-Clause
#include "lens.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <vector>

namespace fild
{
namespace
{
/** Where a pinhole of the same focal length and principal point has each pixel of the lens. */
cv::Mat_<cv::Vec2d> straight_pixels(const CameraModel& camera)
{
    cv::Mat_<cv::Vec2d> pixels(camera.height, camera.width);
    for (int row = 0; row < camera.height; ++row)
        for (int column = 0; column < camera.width; ++column)
            pixels(row, column) = cv::Vec2d(column, row);
    const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
    cv::Mat straight;
    cv::undistortPoints(pixels.reshape(2, camera.width * camera.height),
                        straight,
                        k,
                        distortion,
                        cv::noArray(),
                        k,
                        {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-6});
    return straight.reshape(2, camera.height);
}
}  // namespace

Lens::Lens(const CameraModel& camera)
    : pinhole_(camera), camera_area_(0, 0, camera.width, camera.height)
{
    pinhole_.lens = LensModel::none;
    pinhole_.distortion.fill(0);
    if (camera.lens == LensModel::none) return;
    std::vector<cv::Mat> straight;
    cv::split(straight_pixels(camera), straight);
    const auto limits = [](const cv::Mat& coordinates, int size)
    {
        double least = 0;
        double most = 0;
        cv::minMaxLoc(coordinates, &least, &most);
        return cv::Range(std::min(0, cvFloor(least)), std::max(size, cvCeil(most) + 1));
    };
    const auto columns = limits(straight[0], camera.width);
    const auto rows = limits(straight[1], camera.height);
    pinhole_.width = columns.size();
    pinhole_.height = rows.size();
    pinhole_.cx -= columns.start;
    pinhole_.cy -= rows.start;
    camera_area_ += cv::Point(-columns.start, -rows.start);
    straight[0].convertTo(map_x_, CV_32F, 1, -columns.start);
    straight[1].convertTo(map_y_, CV_32F, 1, -rows.start);
}

RenderedView Lens::view(const std::function<RenderedView(const CameraModel&)>& draw) const
{
    auto whole = draw(pinhole_);
    if (map_x_.empty()) return whole;
    RenderedView seen;
    cv::remap(whole.image, seen.image, map_x_, map_y_, cv::INTER_LINEAR);
    seen.depth = whole.depth(camera_area_).clone();
    return seen;
}

}  // namespace fild
