// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/rigid_transform.h"
#include "undistorter.h"

namespace fild
{
/** Views in which a point has the same row in both images of a stereo pair (the same column when
 *  the right camera stands above or below the left one). Value type. */
struct Rectification
{
    PinholeView left;
    PinholeView right;
    RigidTransform left_from_right;  ///< between the views
};

/** The view of the left camera, for which the right camera's intrinsics need not be known.
 *
 *  Both cameras are turned by the least angle that brings the baseline onto an axis of theirs and
 *  their optical axes into one direction (A. Fusiello, E. Trucco, A. Verri, "A compact algorithm
 *  for rectification of stereo pairs", Machine Vision and Applications 12, 2000). The view has the
 *  size of the image, and its middle shows what the middle of the image shows. A camera without
 *  distortion that is not to be turned by a fiftieth of a pixel stays as it is.
 *  \param left_from_right  with a usable baseline, see is_usable_baseline(). */
PinholeView rectified_left(const CameraModel& left, const RigidTransform& left_from_right);

/** Both views. The right one has the size and intrinsics of the left one, unless the right camera
 *  is rectified as it is. */
Rectification rectify(const CameraModel& left,
                      const CameraModel& right,
                      const RigidTransform& left_from_right);

}  // namespace fild
