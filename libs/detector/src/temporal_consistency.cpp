// SPDX-License-Identifier: BSD-3-Clause
// Temporal consistency of FILD (An et al., IROS 2019), section III-C, end.
#include "fild/detector/temporal_consistency.h"

#include <cmath>

namespace fild
{
TemporalConsistency::TemporalConsistency(const TConsistencyOptions& options)
    : consecutive_frames_(options.consecutive_frames),
      max_candidate_step_seconds_(options.max_candidate_step_seconds)
{
    options.check();
}

bool TemporalConsistency::add_verified(double candidate_time)
{
    const double step = std::abs(candidate_time - last_candidate_time_);
    const bool elsewhere = max_candidate_step_seconds_ > 0 && step > max_candidate_step_seconds_;
    row_ = elsewhere ? 1 : row_ + 1;
    last_candidate_time_ = candidate_time;
    return row_ >= consecutive_frames_;
}

}  // namespace fild
