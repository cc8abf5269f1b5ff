// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/pair_poses.h"

#include "fild/core/parallel_for.h"

#include <algorithm>
#include <cstdint>

namespace fild
{
PairPoses::PairPoses(const TDetectorOptions& options)
    : pairs_(options),
      poses_(options.relative_pose, static_cast<std::uint64_t>(options.runtime.seed))
{
}

RelativePose PairPoses::estimate(const Place& query,
                                 const KeypointDepths& query_depths,
                                 const Place& candidate,
                                 const KeypointDepths& candidate_depths,
                                 StageTimes& times) const
{
    const auto pair = pairs_.verify(query.local, candidate.local, times);
    if (pair.verification.rejection != Rejection::none)
    {
        RelativePose unverified;
        unverified.reason = NoMetricPose::too_few_points;
        return unverified;
    }
    const StageTimer timer(times, "relative_pose");
    return poses_.estimate({query.metric.camera, query.local.positions, query_depths},
                           {candidate.metric.camera, candidate.local.positions, candidate_depths},
                           pair.inliers());
}

TDetectorOptions without_doubt(const TDetectorOptions& options)
{
    auto changed = options;
    auto& verification = changed.verification;
    verification.min_inliers = std::min(verification.min_inliers, options.relative_pose.min_points);
    changed.same_place.enabled = false;
    changed.relative_pose.min_inlier_share /= 2;
    return changed;
}

void timed_parallel_for(int num_threads,
                        std::size_t count,
                        StageTimes& times,
                        const CheckCancelled& check_cancelled,
                        const std::function<void(std::size_t, StageTimes&)>& body)
{
    std::vector<StageTimes> own_times(count);
    parallel_for(num_threads,
                 count,
                 [&](std::size_t i)
                 {
                     check_cancelled();
                     body(i, own_times[i]);
                 });
    for (const auto& own : own_times) times.merge(own);
}

}  // namespace fild
