// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"

#include <optional>
#include <string>

namespace fild
{
/** What is known of a camera, or of a rectified stereo pair, whose images share one camera model.
 *  Value type. */
struct Calibration
{
    CameraModel camera;
    /** How far the right camera's centre is to the right of the left one's, metres, above 0. */
    std::optional<double> baseline_m;
};

/** Reads a calibration file: the line of parse_camera_model, then for a stereo pair the line
 *  `baseline METRES`; with one camera that line is allowed and says nothing, so that one file
 * serves both. Blank lines and lines that begin with `#` are passed over.
 *  \throw std::runtime_error naming file and line. */
Calibration read_calibration_file(const std::string& path);

}  // namespace fild
