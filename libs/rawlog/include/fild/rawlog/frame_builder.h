// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/frame.h"
#include "fild/rawlog/input_options.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace mrpt::obs
{
class CObservation;
}

namespace fild
{
/** How much of an observation a frame is to hold. */
enum class FrameContent
{
    image,  ///< what finding loops takes
    metric  ///< and what metric poses take: Frame::right or Frame::depth, and robot_from_camera
};

/** Turns the observations of one camera into frames, numbered from 0 in the order of the calls.
 *
 *  Camera observations are CObservationImage, CObservationStereoImages (its left image) and
 *  CObservation3DRangeScan with an intensity image. For each observation of a rawlog, in order:
 *  accepts(), and when it is accepted one of build() and skip(). A second pass over the rawlog with
 *  a fresh builder gives the same ids, so that chosen frames can be had again at little cost:
 *  \code
 *  while (auto observation = reader.next())
 *      if (builder.accepts(*observation)) {
 *          if (wanted.count(builder.next_id())) draw(builder.build(*observation));
 *          else builder.skip(*observation);
 *      }
 *  \endcode
 *  Deterministic. Not thread-safe: one caller at a time. */
class FrameBuilder
{
 public:
    /** \param rawlog_path  where external images are looked for, see TInputOptions::images_dir.
     *  \param content  see build(). \throw std::invalid_argument on bad options. */
    FrameBuilder(const TInputOptions& options,
                 const std::string& rawlog_path,
                 FrameContent content = FrameContent::image);
    FrameBuilder(const FrameBuilder&) = delete;
    FrameBuilder& operator=(const FrameBuilder&) = delete;
    ~FrameBuilder();

    /** True for an observation of the wanted camera. Notes the label of every observation. */
    bool accepts(const mrpt::obs::CObservation& observation);

    /** The frame of an accepted observation. One that cannot be used has Frame::defect:
     *  missing_image, unsupported_image, image_size_changed (it cannot be brought to the size of
     *  this camera's first image) or repeated_timestamp (it has time stamp and pixels of this
     *  camera's observation before: recorded twice). An observation without a time stamp takes that
     *  of this camera's frame before; 0 when there is none. Images of 16 bits are reduced to 8. A
     *  label that is not UTF-8 is taken for Latin-1. An embedded image that needs no undistortion
     *  is shared with the observation, not copied.
     *
     *  All frames of a camera have the size of its first image. One of another size, as a second
     *  session with another camera mode has, is scaled to it. Where the aspect ratios differ by
     *  more than 3 %, the larger of the two scale factors is used and the overhang cut off equally
     *  on both sides. Camera, right image and depth follow. Its calibration must be for its own
     *  size, or, when the aspect ratios agree, for the first one's; any other is left out, see
     *  calibration_notes().
     *  image_size_changed: the aspect ratios differ by a factor of more than 1.5, or the sizes by
     *  more than 8.
     *
     *  Stereo pairs with a usable baseline are rectified where `undistort` is set: the left image
     *  is what the left camera shows when it is turned so that the right one stands beside it (or
     *  below it) along an axis, and Frame::robot_from_camera has that turn; with a right image or
     *  without. With FrameContent::metric the right image of CObservationStereoImages is there; the
     *  range image of CObservation3DRangeScan becomes depths of the pixels of `image`, projected
     *  where the two cameras are not one. `camera_parameters` replaces the calibration of both
     *  cameras of a pair, and of a depth camera that shares the image's calibration. Where there is
     *  no depth, Frame::depth_defect says why; the frame itself is none the worse.
     *  \throw std::invalid_argument when the observation has no camera image.
     *  \throw std::runtime_error when an image is missing and on_missing_image is `stop` (with
     *         FrameContent::metric, a right or depth image stored outside the rawlog too). */
    Frame build(const mrpt::obs::CObservation& observation);

    /** Counts an accepted observation as a frame. Reads its image only while the size of this
     *  camera's first image is not known: frames that are built later are scaled to it. So it
     *  cannot see repeated_timestamp.
     *  \return the frame without its image. */
    Frame skip(const mrpt::obs::CObservation& observation);

    /** Id of the next frame; as a number, how many there were. */
    FrameId next_id() const;

    /** How many frames build() has scaled to the size of their camera's first image. */
    std::size_t scaled_frames() const;

    /** Path of the first externally stored image (with FrameContent::metric, or right or depth
     *  image) that could not be read, and ", which cannot be read" where the file exists; empty:
     *  none was missing. */
    std::string first_missing_image() const;

    /** "frame 7: 32 bit floating point, 1 channel", the first image whose pixels cannot be used;
     *  empty: there was none. */
    std::string first_unsupported_image() const;

    /** For the user, of each camera whose calibration is for another size than its images have: the
     *  two sizes, and what to do. */
    std::vector<std::string> calibration_notes() const;

    /** Labels of cameras that were seen and not wanted, sorted: for a warning. */
    std::vector<std::string> ignored_camera_labels() const;

    /** All labels seen, for an error message: "camera labels there: A, B; others: C". */
    std::string describe_labels() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fild
