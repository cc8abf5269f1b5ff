// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"

#include <opencv2/core/types.hpp>

#include <string>

namespace fild
{
/** "640x480" */
std::string to_text(cv::Size size);

/** What to do about a calibration that is not for the size of the images: the value of [input]
 *  camera_parameters that mends it, where that can be told. When the principal point is near the
 *  middle of the images only the calibration's size is wrong; when it is near the middle of the
 *  calibrated size, and both sizes have one aspect ratio, the images were scaled. */
std::string mending_advice(const CameraModel& camera, cv::Size images);

}  // namespace fild
