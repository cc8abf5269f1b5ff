// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/loop_poses.h"

#include <cstdint>
#include <vector>

namespace fild
{
namespace
{
PoseView view_of(const Place& place)
{
    return {place.metric.camera, place.local.positions, place.metric.depths};
}
}  // namespace

LoopPoses::LoopPoses(const TDetectorOptions& options)
{
    if (options.relative_pose.enabled)
        poses_.emplace(options.relative_pose, static_cast<std::uint64_t>(options.runtime.seed));
}

void LoopPoses::add_pose(DetectorOutcome& outcome, const PlaceMap& places, StageTimes& times) const
{
    if (!poses_ || !outcome.verdict.accepted()) return;
    const StageTimer timer(times, "relative_pose");
    std::vector<Match> verified;
    verified.reserve(outcome.inliers.size());
    for (const auto k : outcome.inliers) verified.push_back(outcome.keypoint_matches[k]);
    outcome.pose = poses_->estimate(view_of(places.at(outcome.verdict.frame)),
                                    view_of(places.at(outcome.verdict.candidate->frame)),
                                    verified);
}

}  // namespace fild
