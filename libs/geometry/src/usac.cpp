// SPDX-License-Identifier: BSD-3-Clause
#include "usac.h"

namespace fild
{
int usac_random_state(std::uint64_t seed)
{
    return static_cast<int>(seed % 0x7FFFFFFFU);
}

cv::UsacParams magsac_parameters(const RansacLimits& limits, int random_state)
{
    cv::UsacParams usac;
    usac.threshold = limits.max_error;
    usac.confidence = limits.confidence;
    usac.maxIterations = limits.max_iterations;
    usac.randomGeneratorState = random_state;
    usac.isParallel = false;
    usac.loMethod = cv::LOCAL_OPTIM_SIGMA;
    usac.score = cv::SCORE_METHOD_MAGSAC;
    return usac;
}

}  // namespace fild
