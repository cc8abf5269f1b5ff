// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"

#include <optional>

namespace mrpt::img
{
class TCamera;
}

namespace fild
{
/** The camera as `core` knows it, or nothing when it is not calibrated (a focal length that is not
 *  positive, as MRPT leaves it by default). The coefficients of `none` are dropped. Never throws.
 */
std::optional<CameraModel> camera_model_from(const mrpt::img::TCamera& camera);

/** The camera as an observation of MRPT carries it. Never throws. */
mrpt::img::TCamera mrpt_camera_from(const CameraModel& camera);

}  // namespace fild
