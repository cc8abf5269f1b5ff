// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/verdict.h"

#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>

namespace fild
{
/** One camera frame as the detector sees it.
 *
 *  `image` is 8 bit, one channel (grey) or three (BGR, OpenCV's order), lens distortion already
 *  undone where that was asked for. Value type; copies share the pixels, as cv::Mat does. */
struct Frame
{
    FrameId id{};  ///< position among all camera frames of the run, from 0
    double timestamp = 0;  ///< seconds since the UNIX epoch
    std::string sensor_label;
    cv::Mat image;
    std::optional<CameraModel>
        camera;  ///< of `image`, hence after undistortion; none: uncalibrated
    /** Why the frame cannot be used (`image` is then empty), or Rejection::none. Such a frame keeps
     *  its id, so that indices go on matching the recording and its ground truth. */
    Rejection defect = Rejection::none;
};

}  // namespace fild
