// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/keyframes.h"

#include "fild/core/angle.h"
#include "fild/graph/se3.h"

#include <cmath>

namespace fild
{
namespace
{
bool reaches(double value, double limit)
{
    return limit > 0 && value >= limit;
}

bool is_far(const TrajectoryPose& before, const TrajectoryPose& now, const TGraphOptions& options)
{
    const Vector6 moved =
        tangent_of(to_rigid(before.map_from_robot).inverse() * to_rigid(now.map_from_robot));
    return reaches(moved.head<3>().norm(), options.keyframe_distance_m) ||
           reaches(moved.tail<3>().norm() / kRadiansPerDegree, options.keyframe_angle_deg) ||
           reaches(std::abs(now.timestamp - before.timestamp), options.keyframe_seconds);
}
}  // namespace

std::vector<FrameId> select_keyframes(const Trajectory& trajectory,
                                      const TGraphOptions& options,
                                      const std::set<FrameId>& required)
{
    options.check();
    const auto& poses = trajectory.poses();
    std::vector<FrameId> keyframes;
    const TrajectoryPose* last = nullptr;
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
        const auto& now = poses[i];
        const bool is_first = last == nullptr || last->segment != now.segment;
        const bool is_last = i + 1 == poses.size() || poses[i + 1].segment != now.segment;
        if (!is_first && !is_last && required.count(now.frame) == 0 && !is_far(*last, now, options))
            continue;
        keyframes.push_back(now.frame);
        last = &now;
    }
    return keyframes;
}

}  // namespace fild
