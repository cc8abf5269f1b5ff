// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/frame_poses.h"

#include "fild/graph/se3.h"

#include <optional>

namespace fild
{
namespace
{
/** A node's new pose and its old one. */
struct Anchor
{
    Rigid corrected;
    Rigid original;
    int segment = 0;
};

std::vector<std::optional<Anchor>> anchors_of(const Trajectory& trajectory, const PoseGraph& graph)
{
    std::vector<std::optional<Anchor>> anchors;
    anchors.reserve(trajectory.poses().size());
    auto node = graph.nodes.begin();
    for (const auto& pose : trajectory.poses())
    {
        while (node != graph.nodes.end() && node->frame < pose.frame) ++node;
        anchors.emplace_back();
        if (node != graph.nodes.end() && node->frame == pose.frame)
            anchors.back() =
                Anchor{to_rigid(node->map_from_robot), to_rigid(pose.map_from_robot), pose.segment};
    }
    return anchors;
}

Rigid moved_with(const Anchor& anchor, const Rigid& original)
{
    return anchor.corrected * anchor.original.inverse() * original;
}

Rigid between(const Anchor& before, const Anchor& after, const Rigid& original)
{
    const double from_before = (original.translation - before.original.translation).norm();
    const double to_after = (after.original.translation - original.translation).norm();
    const double way = from_before + to_after;
    const double share = way > 0 ? from_before / way : 0;
    return between(moved_with(before, original), moved_with(after, original), share);
}

/** For each pose the nearest anchor of its segment at it or before it. */
std::vector<std::optional<Anchor>> latest(const std::vector<TrajectoryPose>& poses,
                                          std::vector<std::optional<Anchor>> anchors)
{
    for (std::size_t i = 1; i < anchors.size(); ++i)
        if (!anchors[i] && anchors[i - 1] && poses[i].segment == anchors[i - 1]->segment)
            anchors[i] = anchors[i - 1];
    return anchors;
}

/** The same for at it or after it. */
std::vector<std::optional<Anchor>> next(const std::vector<TrajectoryPose>& poses,
                                        std::vector<std::optional<Anchor>> anchors)
{
    for (std::size_t i = anchors.size(); i-- > 1;)
        if (!anchors[i - 1] && anchors[i] && poses[i - 1].segment == anchors[i]->segment)
            anchors[i - 1] = anchors[i];
    return anchors;
}
}  // namespace

std::vector<TrajectoryPose> corrected_poses(const Trajectory& trajectory, const PoseGraph& graph)
{
    auto poses = trajectory.poses();
    const auto anchors = anchors_of(trajectory, graph);
    const auto before = latest(poses, anchors);
    const auto after = next(poses, anchors);
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
        const Rigid original = to_rigid(poses[i].map_from_robot);
        Rigid corrected = original;
        if (before[i] && after[i])
            corrected = between(*before[i], *after[i], original);
        else if (before[i] || after[i])
            corrected = moved_with(before[i] ? *before[i] : *after[i], original);
        poses[i].map_from_robot = to_pose(corrected);
    }
    return poses;
}

}  // namespace fild
