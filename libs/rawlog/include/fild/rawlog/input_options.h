// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/rawlog/rawlog_reader.h"

#include <optional>
#include <string>

namespace fild
{
/** What to do when a frame's externally stored image is absent or unreadable. */
enum class OnMissingImage
{
    skip,  ///< the frame stays in the count, as Rejection::missing_image
    stop  ///< an error
};

/** Sensor labels of the two cameras of a stereo pair. Value type. */
struct StereoLabels
{
    std::string left;
    std::string right;
};

/** Section `[input]`: which frames of a rawlog are taken, and how. */
struct TInputOptions : Options
{
    /** Regular expression (ECMAScript) that must match the whole label of the camera. Empty: the
     *  label of the first camera observation in the rawlog, and only that one. */
    std::string sensor_label;
    /** Folder of the externally stored images. Empty: the first of `NAME_Images`, `NAME_images`,
     *  `NAME_IMAGES` and `Images` that exists beside the rawlog `NAME.rawlog`, as MRPT does. */
    std::string images_dir;
    OnMissingImage on_missing_image = OnMissingImage::skip;
    /** Undo lens distortion where the camera is calibrated and has any. */
    bool undistort = true;
    /** `fx fy cx cy width height [k1 k2 p1 p2 [k3]]` in pixels, instead of the calibration the
     *  observations carry, that of a right camera too. Empty: the observations'. */
    std::string camera_parameters;
    /** `LEFT,RIGHT`: the labels of two cameras whose single images are stereo pairs, see
     *  StereoPairing. Empty: such cameras are found. `none`: every camera stands alone. */
    std::string stereo_labels;
    /** Largest difference of the time stamps of a pair's two images. */
    double stereo_tolerance_seconds = 0.02;
    /** Memory that one entry of a rawlog may take, see RawlogReader. */
    int max_entry_megabytes = kDefaultMaxEntryMegabytes;

    /** The cameras that stereo_labels names. */
    std::optional<StereoLabels> named_pair() const;
    bool finds_pairs() const { return stereo_labels.empty(); }

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

}  // namespace fild
