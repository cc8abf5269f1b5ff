// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "integral_image.h"

#include <array>

namespace fild
{
using SurfDescriptor = std::array<float, LocalFeatures::dimension>;

/** The extended SURF descriptor, SURF section 4.2: a square of side 20s in the keypoint's
 * direction, 4x4 subregions of 5x5 Haar wavelets of side 2s, weighted by a Gaussian of 3.3s. Order
 * of the numbers as in SurfExtractor::extract. \return of unit norm, or all 0 where nothing
 * changes. */
SurfDescriptor surf_descriptor(const IntegralImage& integral, const Keypoint& keypoint);

}  // namespace fild
