// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/calib3d.hpp>

#include <cstdint>

namespace fild
{
/** OpenCV's kind of a seed. */
int usac_random_state(std::uint64_t seed);

/** When a RANSAC ends. */
struct RansacLimits
{
    double max_error = 0;  ///< of an inlier, in the unit of the data
    double confidence = 0.999;
    int max_iterations = 2000;
};

/** OpenCV's USAC as MAGSAC++ (Barath et al., CVPR 2020) with local optimisation, in one thread: a
 *  parallel one would not repeat. */
cv::UsacParams magsac_parameters(const RansacLimits& limits, int random_state);

}  // namespace fild
