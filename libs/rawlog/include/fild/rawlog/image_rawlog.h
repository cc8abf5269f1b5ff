// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/recording.h"

#include <cstddef>
#include <optional>
#include <string>

namespace fild
{
/** How write_image_rawlog() is to write a recording. Value type. */
struct ImageRawlogRequest
{
    std::string rawlog_path;  ///< must end in ".rawlog"
    /** Nothing: CAMERA1, and of two cameras CAMERA_LEFT and CAMERA_RIGHT. */
    std::optional<std::string> sensor_label{};
    bool embed = false;  ///< pixels in the rawlog rather than in files beside it
};

/** What write_image_rawlog() made. Value type. */
struct ImageRawlogSummary
{
    std::size_t frames = 0;  ///< of the left camera where there are two
    std::size_t images = 0;  ///< distinct image files, left and right; depth not counted
    std::size_t depth_images = 0;
    std::string images_dir;  ///< empty when the images are embedded
    std::string ground_truth_path;  ///< empty when the recording has no path of the robot
};

/** For the user, a line or two. */
std::string summary_text(const ImageRawlogSummary& summary);

/** Writes a recording into a gzipped rawlog, an observation a frame: CObservationImage,
 *  CObservationStereoImages for a stereo pair, CObservation3DRangeScan for an image with depth. Of
 *  two cameras that recorded by themselves, each image is a CObservationImage, in the order of
 *  time. The robot's frame is that of StampedPose, so a camera's pose on the robot is (0, 0, 0, -90
 *  deg, 0, -90 deg); a range scan's own frame is that of the robot.
 *
 *  Unless embedded, each distinct image file is put once into `NAME_Images` beside `NAME.rawlog`,
 * by hard link where the file system allows it (so one must not edit it in place), else as a copy.
 *  Left and right image of one name become `name_left.png` and `name_right.png`; of two different
 *  files of one name the second becomes `name_2.png`. Depth is stored in the rawlog always, as it
 *  is, with rangeUnits = 1 / depth_units_per_metre. The path of the robot goes to `NAME.gt.tum`:
 *  `seconds x y z qx qy qz qw` a line.
 *
 *  Every image is decoded once to see that it is whole. Rawlog, folder and path appear under their
 *  names only when all are done. Cost: decoding each distinct image (each frame's, when embedded).
 *  Deterministic.
 *  \throw std::invalid_argument when the path does not end in ".rawlog", the label is empty, there
 *         is no frame, sensor_label is set although there are two cameras, or the recording breaks
 *         a rule of its docstring.
 *  \throw std::runtime_error naming file and origin: an output exists already, an image is
 *         unreadable, neither 8-bit grey nor 8-bit colour (depth: 16-bit grey), not of the
 *         calibrated size or not of the size of the image beside it; full disk. */
ImageRawlogSummary write_image_rawlog(const Recording& recording,
                                      const ImageRawlogRequest& request);

}  // namespace fild
