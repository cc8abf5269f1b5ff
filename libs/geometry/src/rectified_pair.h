// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/frame.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace fild
{
/** Both images of a stereo pair as two equal cameras would have taken them that differ by a
 *  movement along their x axis only, so that a point has the same y in both. */
struct RectifiedPair
{
    cv::Mat left;  ///< float, grey values
    cv::Mat right;
    double focal_px = 0;
    double baseline_m = 0;
    cv::Point2d principal_point;
    cv::Matx33d left_pixel_from_raw;  ///< homogeneous pixels
    cv::Matx33d right_pixel_from_raw;
    cv::Matx33d camera_from_rectified;  ///< rotation back to the left camera's axes
};

/** \param frame  with a calibrated left and right image.
 *  \param left_from_right  that of the frame, or as it was when the images were taken; with a
 *  usable baseline. */
RectifiedPair rectified_pair(const Frame& frame, const RigidTransform& left_from_right);

/** Pixels through a homography. */
std::vector<cv::Point2d> transformed(const std::vector<PixelPosition>& pixels,
                                     const cv::Matx33d& homography);

}  // namespace fild
