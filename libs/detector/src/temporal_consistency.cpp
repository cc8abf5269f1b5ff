// SPDX-License-Identifier: BSD-3-Clause
// Temporal consistency of FILD (An et al., IROS 2019), section III-C, end.
#include "fild/detector/temporal_consistency.h"

#include <cmath>

namespace fild
{
TemporalConsistency::TemporalConsistency(const TConsistencyOptions& options)
    : consecutive_frames_(options.consecutive_frames),
      max_candidate_step_seconds_(options.max_candidate_step_seconds),
      sure_inliers_(static_cast<std::size_t>(options.sure_inliers)),
      sure_inlier_share_(options.sure_inlier_share)
{
    options.check();
}

bool TemporalConsistency::add_verified(double candidate_time,
                                       std::size_t inliers,
                                       std::size_t keypoints)
{
    const double step = std::abs(candidate_time - last_candidate_time_);
    const bool elsewhere = max_candidate_step_seconds_ > 0 && step > max_candidate_step_seconds_;
    row_ = elsewhere ? 1 : row_ + 1;
    last_candidate_time_ = candidate_time;
    return sure_by_itself(inliers, keypoints) || row_ >= consecutive_frames_;
}

bool TemporalConsistency::sure_by_itself(std::size_t inliers, std::size_t keypoints) const
{
    const auto share = static_cast<double>(inliers) / static_cast<double>(keypoints);
    return sure_inliers_ > 0 && inliers >= sure_inliers_ && share >= sure_inlier_share_;
}

}  // namespace fild
