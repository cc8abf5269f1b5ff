// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/rigid_transform.h"

#include <optional>
#include <string>

namespace fild
{
/** What is known of a camera, or of the two of a stereo pair. Value type. */
struct Calibration
{
    CameraModel camera;  ///< the left one where there are two
    /** How far the right camera's centre is to the right of the left one's, metres, above 0; both
     *  look the same way. */
    std::optional<double> baseline_m{};
    std::optional<CameraModel> right{};  ///< nothing: as `camera`
    std::optional<RigidTransform> right_pose{};  ///< in the left camera, instead of baseline_m

    /** The pose of the right camera in the left one, if it is known. */
    std::optional<RigidTransform> left_from_right() const;
    const CameraModel& right_camera() const { return right ? *right : camera; }
};

/** Reads a calibration file: the line of parse_camera_model, then for a stereo pair the line
 *  `baseline METRES`, or `right_pose X Y Z QX QY QZ QW`, the pose of the right camera in the left
 *  one (x right, y down, z forward), and where the right camera is another, `right` and its numbers
 *  as in the first line. With one camera those lines are allowed and say nothing, so that one file
 *  serves both. Blank lines and lines that begin with `#` are passed over.
 *  \throw std::runtime_error naming file and line. */
Calibration read_calibration_file(const std::string& path);

}  // namespace fild
