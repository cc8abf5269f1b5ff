// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/recording.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** How a recording lies on disk; each has a read function below. */
enum class ImageLayout
{
    list,  ///< a folder or list of images, with a folder of depth or without
    kitti,
    malaga,
    newcollege,
    tum,
    stereo  ///< a folder of left images and one of right images
};

/** Every layout with the word a user writes for it, `list` first. */
const std::vector<std::pair<std::string, ImageLayout>>& layout_words();

/** \throw std::invalid_argument for another word. */
ImageLayout layout_named(const std::string& word);

/** What a user says of a recording on disk. Value type. */
struct LayoutRequest
{
    ImageLayout layout = ImageLayout::list;
    std::string images_dir;
    std::optional<std::string> list_path;  ///< instead of `images_dir`
    TimestampSource timestamps;
    std::optional<std::string> calibration_path;  ///< of read_calibration_file
    std::optional<std::string> right_dir;
    std::optional<std::string> depth_dir;
    /** Nothing: 5000 for `tum`, else 1000. */
    std::optional<double> depth_units_per_metre;
};

/** Reads what was asked for with the function of the layout.
 *  \throw std::invalid_argument naming the option that does not go with the layout, or that it
 *         needs; all that the functions throw. */
Recording read_recording(const LayoutRequest& request);

// The functions look at file names and text files; of the images themselves, only the first one of
// a KITTI folder is opened. Deterministic. All throw std::runtime_error that names what is missing
// or wrong and the way out: no such folder, no image of the layout's form, counts that differ, text
// that does not parse, times that do not grow (see stamp_images), a stereo pair without a
// calibration that has a baseline.

/** Left and right images of two folders, paired by the order of their names. */
Recording read_stereo_folders(const std::string& left_dir,
                              const std::string& right_dir,
                              const TimestampSource& timestamps,
                              const Calibration& calibration);

/** Images, and a folder with the depth of each, paired by order. */
Recording read_images_with_depth(const std::vector<ListedImage>& images,
                                 const std::string& depth_dir,
                                 const TimestampSource& timestamps,
                                 const Calibration& calibration);

/** A sequence of the KITTI odometry benchmark: `image_0/` (left, grey), `image_1/` (right) when it
 *  is there, `times.txt` and `calib.txt` (rows P0 and P1 of 12 numbers). Without `image_0/`, the
 *  colour cameras are taken: `image_2/`, `image_3/`, P2 and P3.
 *  \param timestamps  instead of times.txt, when there is a source in it.
 *  \param calibration  instead of calib.txt. With neither, one camera stays uncalibrated. */
Recording read_kitti_layout(const std::string& folder,
                            const TimestampSource& timestamps,
                            const std::optional<Calibration>& calibration);

/** Images named CAMERA_LEFT_<seconds>.jpg, as of the Malaga 2009 data set, and those named
 *  CAMERA_RIGHT_<seconds>.jpg when there are any: two cameras, each with times of its own, as in
 *  the data set's own rawlog. Any image extension will do. */
Recording read_malaga_layout(const std::string& folder,
                             const std::optional<Calibration>& calibration);

/** Images named StereoImage__<seconds>-left.pnm, as of the New College data set, with those named
 *  StereoImage__<seconds>-right.pnm of the same time when there are any; images without a partner
 *  are then left out, and counted. Any image extension will do. */
Recording read_newcollege_layout(const std::string& folder,
                                 const std::optional<Calibration>& calibration);

/** A sequence of the TUM RGB-D benchmark: `rgb.txt` and `depth.txt` (`seconds path` a line), each
 *  colour image with the depth image nearest in time, within 0.02 s, each used once; those without
 *  a partner are left out, and counted. `groundtruth.txt` when it is there, whole. Frames have the
 *  times of the colour images. */
Recording read_tum_layout(const std::string& folder, const Calibration& calibration);

}  // namespace fild
