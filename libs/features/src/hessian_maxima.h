// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/features/local_feature_options.h"
#include "integral_image.h"
#include "surf_kernels.h"

#include <vector>

namespace fild
{
/** Masks of octave o grow by 6 * 2^o pixels: 9 15 21 27, then 15 27 39 51, 27 51 75 99, ... */
BoxMask mask_of(int octave, int layer);

/** Keypoints of an image, strongest first (ties by y, x, size), at most options.max_keypoints of
 *  them; without angles yet. The result does not depend on num_threads (0: all of the hardware). */
std::vector<Keypoint> find_hessian_maxima(const IntegralImage& integral,
                                          const TLocalFeatureOptions& options,
                                          int num_threads,
                                          const SurfKernels& kernels);

}  // namespace fild
