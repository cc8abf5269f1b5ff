// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

namespace fild
{
/** True when the camera is not a pinhole: a fisheye, or a lens model with a coefficient that is not
 *  zero. */
bool has_distortion(const CameraModel& camera);

/** The camera as a pinhole. */
CameraModel without_distortion(CameraModel camera);

/** A pinhole at the place of a camera, turned against it. Value type. */
struct PinholeView
{
    cv::Matx33d view_from_camera = cv::Matx33d::eye();
    CameraModel camera;  ///< of the view: without distortion
};

/** The view of the camera itself, without its distortion. */
PinholeView straight_view(const CameraModel& camera);

/** Makes images as a pinhole takes them; keeps the lookup maps of the last camera and view. Pixels
 *  from outside are black. Not thread-safe: one caller at a time. */
class Undistorter
{
 public:
    /** What the view shows, in its size.
     *  \param camera  of `image`, the same size. \param interpolation  between pixels; depths are
     *  not to be mixed: INTER_NEAREST.
     *  \return `image` itself when the view is that of the camera. Deterministic. */
    cv::Mat undistort(const cv::Mat& image,
                      const CameraModel& camera,
                      const PinholeView& view,
                      cv::InterpolationFlags interpolation = cv::INTER_LINEAR);

 private:
    void make_maps(const CameraModel& camera, const PinholeView& view);

    CameraModel maps_camera_;
    PinholeView maps_view_;
    cv::Mat map_xy_;
    cv::Mat map_fraction_;
};

}  // namespace fild
