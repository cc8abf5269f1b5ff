// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/types.hpp>

namespace fild
{
/** Viridis without its ends, which are lost on black and on white: dark blue for 0, yellow green
 *  for 1, in an order that colour-blind readers and grey prints keep.
 *  \param share  clamped to [0, 1]. \return BGR, 0 to 255. */
cv::Scalar colour_on_scale(double share);

}  // namespace fild
