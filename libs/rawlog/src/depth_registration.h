// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/rigid_transform.h"

#include <opencv2/core/mat.hpp>

namespace fild
{
/** Distances from the camera's centre to depths along its optical axis.
 *  \param ranges  float, metres, 0: none. \param camera  a pinhole of the size of `ranges`. */
cv::Mat depth_from_ranges(const cv::Mat& ranges, const CameraModel& camera);

/** The depth of each pixel of an image from the depth image of a camera that stands elsewhere.
 *
 *  Each reading is drawn into the image as a square as large as its pixel; of several the nearest
 *  counts. What the depth camera does not see stays without.
 *  \param depth  float, metres, 0: none. \param depth_camera, image_camera  pinholes.
 *  \return float, metres along the optical axis of the image's camera, of its size; 0: none. */
cv::Mat registered_depth(const cv::Mat& depth,
                         const CameraModel& depth_camera,
                         const CameraModel& image_camera,
                         const RigidTransform& image_from_depth);

}  // namespace fild
