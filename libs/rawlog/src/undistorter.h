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

/** Straightens images; keeps the lookup maps of the last camera. The straightened image has the
 *  size, focal lengths and principal point of the camera; pixels from outside are black.
 *  Not thread-safe: one caller at a time. */
class Undistorter
{
 public:
    /** \param camera  of `image`, the same size, with a lens model. \param interpolation  between
     *  pixels; depths are not to be mixed: INTER_NEAREST. Deterministic. */
    cv::Mat undistort(const cv::Mat& image,
                      const CameraModel& camera,
                      cv::InterpolationFlags interpolation = cv::INTER_LINEAR);

 private:
    void make_maps(const CameraModel& camera);

    CameraModel maps_camera_;
    cv::Mat map_xy_;
    cv::Mat map_fraction_;
};

}  // namespace fild
