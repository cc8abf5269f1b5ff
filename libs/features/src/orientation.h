// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "integral_image.h"

namespace fild
{
/** Direction in which brightness grows around a keypoint, radians in [0, 2 pi), from the x axis
 *  towards the y axis; 0 where nothing changes. SURF section 4.1: Haar wavelets of side 4s in a
 * disc of radius 6s, weighted by a Gaussian of 2.5s, summed in a sliding window of pi/3. */
float dominant_orientation(const IntegralImage& integral, const Keypoint& keypoint);

}  // namespace fild
