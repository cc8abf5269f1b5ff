// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/measured_path.h"

#include "eigen_poses.h"

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
/** The pose `part` of the way from a to b, part in [0, 1]. */
FramePose between(const FramePose& a, const FramePose& b, double part)
{
    const Eigen::Quaterniond from(to_eigen(a.rotation));
    const Eigen::Quaterniond to(to_eigen(b.rotation));
    FramePose pose;
    pose.rotation = to_opencv(from.slerp(part, to).toRotationMatrix());
    pose.position = a.position + part * (b.position - a.position);
    return pose;
}

std::optional<FramePose> pose_at(const std::vector<TimedPose>& path, double time)
{
    if (path.empty()) return std::nullopt;
    const auto later = std::lower_bound(path.begin(),
                                        path.end(),
                                        time,
                                        [](const TimedPose& pose, double seconds)
                                        { return pose.timestamp < seconds; });
    const auto at_end = [&](const TimedPose& end)
    {
        return std::abs(end.timestamp - time) <= kMaxPoseTimeDifference ? std::optional(end.pose)
                                                                        : std::nullopt;
    };
    if (later == path.begin()) return at_end(path.front());
    if (later == path.end()) return at_end(path.back());
    const auto& before = *(later - 1);
    const double gap = later->timestamp - before.timestamp;
    if (gap > kMaxMeasurementGap) return std::nullopt;
    return between(before.pose, later->pose, (time - before.timestamp) / gap);
}

/** Rotation about z (up) from the direction of motion. */
std::optional<cv::Matx33d> heading_at(const std::vector<TimedPose>& path, double time)
{
    const auto clamped = [&](double seconds)
    { return pose_at(path, std::clamp(seconds, path.front().timestamp, path.back().timestamp)); };
    const auto before = clamped(time - kHeadingWindow);
    const auto after = clamped(time + kHeadingWindow);
    if (!before || !after) return std::nullopt;
    const cv::Vec3d movement = after->position - before->position;
    const double distance = std::hypot(movement[0], movement[1]);
    if (distance < kLeastMovement) return std::nullopt;
    const double cosine = movement[0] / distance;
    const double sine = movement[1] / distance;
    return cv::Matx33d(cosine, -sine, 0, sine, cosine, 0, 0, 0, 1);
}
}  // namespace

std::vector<PosedFrame> poses_along(const MeasuredPath& path,
                                    const std::vector<FrameVerdict>& frames)
{
    std::vector<PosedFrame> posed;
    posed.reserve(frames.size());
    for (const auto& frame : frames)
    {
        posed.push_back({frame.timestamp, pose_at(path.poses, frame.timestamp)});
        auto& pose = posed.back().pose;
        if (path.oriented || !pose) continue;
        if (const auto heading = heading_at(path.poses, frame.timestamp))
            pose->rotation = *heading;
        else
            pose.reset();
    }
    return posed;
}

}  // namespace fild
