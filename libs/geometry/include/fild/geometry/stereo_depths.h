// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/frame.h"
#include "fild/core/keypoint_depths.h"
#include "fild/geometry/depth_options.h"

namespace fild
{
/** Depths of the left image's keypoints by the right image.
 *
 *  The pair is rectified with its calibration (not resampled where it is rectified already).
 *  Keypoints of both images on one row are matched by their codes, each the other's nearest; then
 *  the patch round the left keypoint is fitted into the right image by least squares, with the
 *  slant of the surface and a change of brightness (W. Förstner, "On the geometric precision of
 *  digital correlation", ISPRS 1982; A. Grün, "Adaptive least squares correlation", 1985). The fit
 *  gives disparity and standard deviation to a part of a pixel; where the patches do not correlate
 *  the depth is unknown. Where the right image was taken later (RightView::seconds_later), the
 *  movement since then is estimated from the matches first. Deterministic.
 *
 *  \param frame  with Frame::right.
 *  \param left,right  keypoints of frame.image and of frame.right->image, by the same extractor and
 *         hasher.
 *  \return source none and no depths when the baseline is not usable, see is_usable_baseline().
 *  \throw std::invalid_argument when the frame has no calibrated right image, a camera's size is
 *         not its image's, or the codes differ in length. */
KeypointDepths depths_from_stereo(const Frame& frame,
                                  const HashedFeatures& left,
                                  const HashedFeatures& right,
                                  const TDepthOptions& options);

}  // namespace fild
