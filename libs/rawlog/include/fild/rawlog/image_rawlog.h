// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/rawlog/image_list.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** What write_image_rawlog() is to make of a list of images. Value type. */
struct ImageRawlogRequest
{
    std::string rawlog_path;  ///< must end in ".rawlog"
    std::string sensor_label = "CAMERA1";
    std::optional<CameraModel> camera;  ///< goes into each observation
    bool embed = false;  ///< pixels in the rawlog rather than in files beside it
};

/** What write_image_rawlog() made. Value type. */
struct ImageRawlogSummary
{
    std::size_t frames = 0;
    std::size_t images = 0;  ///< distinct image files
    std::string images_dir;  ///< empty when the images are embedded
};

/** Writes images as CObservationImage into a gzipped rawlog.
 *
 *  Unless embedded, each distinct file is put once into `NAME_Images` beside `NAME.rawlog`, by hard
 *  link where the file system allows it (so one must not edit it in place), else as a copy; of two
 *  different files of one name the second becomes `name_2.png`. Every image is decoded once to see
 *  that it is whole. Rawlog and folder appear under their names only when both are done. Cost:
 *  decoding each distinct image (each frame's, when embedded). Deterministic.
 *  \throw std::invalid_argument when the path does not end in ".rawlog", the label is empty or
 *         there is no image.
 *  \throw std::runtime_error naming file and origin: rawlog or folder exists already, an image is
 *         unreadable, neither 8-bit grey nor 8-bit colour, or not of the calibrated size; full
 * disk. */
ImageRawlogSummary write_image_rawlog(const std::vector<StampedImage>& images,
                                      const ImageRawlogRequest& request);

}  // namespace fild
