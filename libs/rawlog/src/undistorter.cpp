// SPDX-License-Identifier: BSD-3-Clause
#include "undistorter.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <tuple>

namespace fild
{
namespace
{
auto fields(const CameraModel& c)
{
    return std::tie(c.fx, c.fy, c.cx, c.cy, c.width, c.height, c.lens, c.distortion);
}

bool is_same_view(const PinholeView& a, const PinholeView& b)
{
    return a.view_from_camera == b.view_from_camera && fields(a.camera) == fields(b.camera);
}

cv::Matx33d matrix_of(const CameraModel& camera)
{
    return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}
}  // namespace

bool has_distortion(const CameraModel& camera)
{
    // A fisheye whose coefficients are zero is r = f theta; a pinhole is r = f tan(theta).
    if (camera.lens == LensModel::kannala_brandt) return true;
    return camera.lens != LensModel::none &&
           std::any_of(camera.distortion.begin(),
                       camera.distortion.end(),
                       [](double coefficient) { return coefficient != 0; });
}

CameraModel without_distortion(CameraModel camera)
{
    camera.lens = LensModel::none;
    camera.distortion.fill(0);
    return camera;
}

PinholeView straight_view(const CameraModel& camera)
{
    return {cv::Matx33d::eye(), without_distortion(camera)};
}

cv::Mat Undistorter::undistort(const cv::Mat& image,
                               const CameraModel& camera,
                               const PinholeView& view,
                               cv::InterpolationFlags interpolation)
{
    if (!has_distortion(camera) && is_same_view(view, straight_view(camera))) return image;
    if (map_xy_.empty() || fields(camera) != fields(maps_camera_) ||
        !is_same_view(view, maps_view_))
        make_maps(camera, view);
    cv::Mat straight;
    cv::remap(image, straight, map_xy_, map_fraction_, interpolation);
    return straight;
}

void Undistorter::make_maps(const CameraModel& camera, const PinholeView& view)
{
    const auto k = matrix_of(camera);
    const auto view_k = matrix_of(view.camera);
    const auto& d = camera.distortion;
    const cv::Size size(view.camera.width, view.camera.height);
    if (camera.lens == LensModel::kannala_brandt)
        cv::fisheye::initUndistortRectifyMap(k,
                                             cv::Vec4d(d[0], d[1], d[2], d[3]),
                                             view.view_from_camera,
                                             view_k,
                                             size,
                                             CV_16SC2,
                                             map_xy_,
                                             map_fraction_);
    else
        cv::initUndistortRectifyMap(k,
                                    cv::Mat(1, 8, CV_64F, const_cast<double*>(d.data())),
                                    view.view_from_camera,
                                    view_k,
                                    size,
                                    CV_16SC2,
                                    map_xy_,
                                    map_fraction_);
    maps_camera_ = camera;
    maps_view_ = view;
}

}  // namespace fild
