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

cv::Mat Undistorter::undistort(const cv::Mat& image,
                               const CameraModel& camera,
                               cv::InterpolationFlags interpolation)
{
    if (map_xy_.empty() || fields(camera) != fields(maps_camera_)) make_maps(camera);
    cv::Mat straight;
    cv::remap(image, straight, map_xy_, map_fraction_, interpolation);
    return straight;
}

void Undistorter::make_maps(const CameraModel& camera)
{
    const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    const auto& d = camera.distortion;
    const cv::Size size(camera.width, camera.height);
    const auto no_rotation = cv::Matx33d::eye();
    if (camera.lens == LensModel::kannala_brandt)
        cv::fisheye::initUndistortRectifyMap(k,
                                             cv::Vec4d(d[0], d[1], d[2], d[3]),
                                             no_rotation,
                                             k,
                                             size,
                                             CV_16SC2,
                                             map_xy_,
                                             map_fraction_);
    else
        cv::initUndistortRectifyMap(k,
                                    cv::Mat(1, 8, CV_64F, const_cast<double*>(d.data())),
                                    no_rotation,
                                    k,
                                    size,
                                    CV_16SC2,
                                    map_xy_,
                                    map_fraction_);
    maps_camera_ = camera;
}

}  // namespace fild
