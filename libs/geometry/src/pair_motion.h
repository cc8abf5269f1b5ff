// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/frame.h"

#include <vector>

namespace fild
{
/** Where the right camera was when it took its image, if that was some time after the left one: the
 *  robot moved meanwhile. Matched keypoints of one point lie on epipolar lines; the pose that
 *  brings them there, robustly, is found near the one that the calibration has, as it is for a
 *  robot at some 10 m/s that turns at some 0.3 rad/s. The length of the baseline is not seen and
 *  stays.
 *  \param frame  with a right view.
 *  \param left,right  pixels of the two images. \param matches  Match::query of left,
 *  Match::candidate of right; may hold wrong ones.
 *  \param pixel_deviation  usual distance of a right match from its line.
 *  \return left_from_right; that of the frame when the images are of one moment, or the matches too
 *  few. Deterministic. */
RigidTransform pose_of_moved_right(const Frame& frame,
                                   const std::vector<PixelPosition>& left,
                                   const std::vector<PixelPosition>& right,
                                   const std::vector<Match>& matches,
                                   double pixel_deviation);

}  // namespace fild
