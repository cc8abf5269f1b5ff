// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/frame.h"

#include <opencv2/core/types.hpp>

#include <optional>

namespace fild
{
/** How an image is brought to the size of its camera's first image: scaled, then cut to the middle.
 *  The centre of pixel (x, y) goes to ((x + 0.5) scale_x - 0.5 - kept.x, likewise y). */
struct SizeChange
{
    double scale_x = 1;
    double scale_y = 1;
    cv::Size scaled;  ///< the whole image after scaling
    cv::Rect kept;  ///< the part of it that is kept, of the wanted size
};

/** How to bring an image of size `from` to size `to`.
 *
 *  Aspect ratios that agree within 3 %: each side is scaled by its own factor. Others, up to a
 *  factor of 1.5 (4:3 and 16:9 differ by 1.33): both sides are scaled by the larger factor, and
 *  what then overhangs is cut off equally on both sides. Never padded: the edge of a black bar
 *  would have keypoints that match those of all other padded images.
 *  \return nothing when the aspect ratios differ by more, as portrait and landscape do, or a side
 *  would change by a factor of more than 8: what the images share is then too little, or too
 *  coarse, to be compared. Never throws. */
std::optional<SizeChange> size_change(cv::Size from, cv::Size to);

/** The camera of the image after the change. */
CameraModel changed(const CameraModel& camera, const SizeChange& change);

/** Changes `image`, `depth` and their camera. The right image is scaled by the same factors, so
 * that both views show things equally large, and is not cut. \param frame  with an image of the
 * size that the change is from. */
void change_size(Frame& frame, const SizeChange& change);

/** The calibration for an image of size `image`.
 *  \param first  size of the camera's first image.
 *  \return `camera` when it is for that size; scaled when it is for `first` and the two sizes have
 *  the same aspect ratio within 3 %; else nothing. */
std::optional<CameraModel> camera_for(const CameraModel& camera, cv::Size image, cv::Size first);

}  // namespace fild
