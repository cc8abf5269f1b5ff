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

bool TemporalConsistency::add_verified(const std::string& camera, double candidate_time)
{
    auto& row = rows_[camera];
    const double step = std::abs(candidate_time - row.last_candidate_time);
    const bool elsewhere = max_candidate_step_seconds_ > 0 && step > max_candidate_step_seconds_;
    row.length = elsewhere ? 1 : row.length + 1;
    row.last_candidate_time = candidate_time;
    return row.length >= consecutive_frames_;
}

}  // namespace fild
