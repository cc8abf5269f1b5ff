// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/rigid_transform.h"

#include <opencv2/core/types.hpp>

namespace fild
{
/** From where a picture of a map was taken. Value type. */
struct PictureView
{
    CameraModel camera;  ///< a pinhole
    RigidTransform map_from_camera;  ///< x right, y down, z forward; metres

    /** Where a point of the map lies in the picture, pixels, perhaps beyond its border. The point
     *  must lie before the camera, as all that the picture was framed for does. */
    cv::Point2d project(const cv::Vec3d& in_map) const;
};

}  // namespace fild
