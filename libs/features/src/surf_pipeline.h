// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/features/local_feature_options.h"
#include "surf_kernels.h"

#include <opencv2/core/mat.hpp>

namespace fild
{
/** SurfExtractor::extract() with kernels of one's choice. */
LocalFeatures extract_surf(const cv::Mat& image,
                           const TLocalFeatureOptions& options,
                           int num_threads,
                           const SurfKernels& kernels);

}  // namespace fild
