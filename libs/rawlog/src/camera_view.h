// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>

#include <optional>

namespace mrpt::obs
{
class CObservation;
}

namespace fild
{
/** The image of an observation and the camera that took it; refers to the observation. */
struct CameraView
{
    const mrpt::img::CImage& image;
    const mrpt::img::TCamera& camera;
};

/** Of a stereo pair the left image; nothing for an observation without an image. */
std::optional<CameraView> camera_view_of(const mrpt::obs::CObservation& observation);

}  // namespace fild
