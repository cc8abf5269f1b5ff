// SPDX-License-Identifier: BSD-3-Clause
// Temporal consistency of FILD (An et al., IROS 2019), section III-C, end.
#include "fild/detector/temporal_consistency.h"

#include <cmath>

namespace fild
{
TemporalConsistency::TemporalConsistency(const TConsistencyOptions& options)
    : consecutive_frames_(options.consecutive_frames),
      max_candidate_step_seconds_(options.max_candidate_step_seconds),
      sure_inliers_(static_cast<std::size_t>(options.sure_inliers))
{
    options.check();
}

bool TemporalConsistency::add_verified(double candidate_time, std::size_t inliers)
{
    const double step = std::abs(candidate_time - last_candidate_time_);
    const bool elsewhere = max_candidate_step_seconds_ > 0 && step > max_candidate_step_seconds_;
    row_ = elsewhere ? 1 : row_ + 1;
    last_candidate_time_ = candidate_time;
    const bool sure = sure_inliers_ > 0 && inliers >= sure_inliers_;
    return sure || row_ >= consecutive_frames_;
}

}  // namespace fild
