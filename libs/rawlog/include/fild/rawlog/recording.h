// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/calibration_file.h"
#include "fild/rawlog/image_list.h"

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** What a camera head recorded at one moment: an image, the left and right image of a stereo pair,
 *  or an image and the depth of each of its pixels. Value type. */
struct RecordedFrame
{
    StampedImage image;  ///< 8 bit, grey or colour; of the left camera where there are two
    std::optional<ImageFile> right;  ///< 8 bit
    std::optional<ImageFile> depth;  ///< 16 bit, the size of `image`; 0: no reading
};

/** Where the robot was: its pose in a fixed frame, as position in metres and unit quaternion. The
 *  robot's frame has x forward, y left, z up and its origin in the (left) camera's centre. */
struct StampedPose
{
    double seconds = 0;
    double x = 0;
    double y = 0;
    double z = 0;
    double qx = 0;
    double qy = 0;
    double qz = 0;
    double qw = 1;
};

/** Image files on disk and all that is known of them: what a data set's layout is read into, and
 *  what a rawlog is written from. Either all frames have a right image, or all have depth, or none
 *  has either; and only then may there be images of a right camera that recorded by itself. Value
 *  type. */
struct Recording
{
    std::vector<RecordedFrame> frames;  ///< times grow
    std::vector<StampedImage> right_camera;  ///< its images; times grow
    /** With right images: there, and with the right camera's pose. */
    std::optional<Calibration> calibration;
    double depth_units_per_metre = 1000;  ///< of the depth images' numbers
    std::vector<StampedPose> robot_path;  ///< ground truth; empty: unknown
    std::vector<std::string> left_out;  ///< for the user: "2 left images without a right one"
};

/** A recording of one camera. */
Recording mono_recording(std::vector<StampedImage> images,
                         const std::optional<Calibration>& calibration = std::nullopt);

}  // namespace fild
