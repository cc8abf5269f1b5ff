// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/frame.h"
#include "fild/core/keypoint_depths.h"
#include "fild/geometry/depth_options.h"

#include <vector>

namespace fild
{
/** Depths of keypoints by the frame's depth image.
 *
 *  Between four pixels the inverse depth is interpolated, which is exact on a plane. Where one of
 *  them is unknown, or they differ by more than options.max_step, the depth is unknown; so it is
 *  within 3 pixels of a hole, of a step or bend of that size, and of the border: a blob there is on
 *  no one surface for sure. Deterministic. Never throws on what the image holds.
 *  \param positions  pixels of frame.image; those outside have no depth.
 *  \throw std::invalid_argument when the frame has no depth image, or one that is not float. */
KeypointDepths depths_from_image(const Frame& frame,
                                 const std::vector<PixelPosition>& positions,
                                 const TDepthOptions& options);

}  // namespace fild
