// SPDX-License-Identifier: BSD-3-Clause
#include "map_pictures.h"

#include "fild/core/spread.h"
#include "fild/evaluation/trajectory_error.h"
#include "fild/job/interruption.h"
#include "fild/rawlog/pose_conversion.h"
#include "picture_file.h"

#include <algorithm>

namespace fild
{
namespace
{
std::vector<PlacedFrame> placed(const std::vector<TrajectoryPose>& poses)
{
    std::vector<PlacedFrame> frames;
    frames.reserve(poses.size());
    for (const auto& pose : poses)
        frames.push_back({pose.frame, rigid_transform_from(pose.map_from_robot), pose.segment});
    return frames;
}

/** Those with most support; of equals the earlier. */
std::vector<std::pair<FrameId, FrameId>> rejected_pairs(const std::vector<FrameVerdict>& verdicts,
                                                        std::size_t count)
{
    std::vector<const FrameVerdict*> rejected;
    for (const auto& verdict : verdicts)
        if (!verdict.accepted() && verdict.candidate) rejected.push_back(&verdict);
    std::stable_sort(rejected.begin(),
                     rejected.end(),
                     [](const auto* a, const auto* b) { return a->support > b->support; });
    rejected.resize(std::min(count, rejected.size()));
    std::vector<std::pair<FrameId, FrameId>> pairs;
    pairs.reserve(rejected.size());
    for (const auto* verdict : rejected)
        pairs.emplace_back(verdict->frame, verdict->candidate->frame);
    return pairs;
}
}  // namespace

DrawnMap to_drawn_map(const Map& map,
                      const std::vector<FrameVerdict>& verdicts,
                      const TRenderOptions& options)
{
    DrawnMap drawn;
    drawn.optimized = placed(map.optimized);
    drawn.input = placed(map.trajectory.poses());
    for (const auto& loop : map.loops)
        drawn.loops.push_back({loop.query,
                               loop.candidate,
                               verdicts.at(to_index(loop.query)).inliers,
                               loop.result.weight});
    drawn.rejected = rejected_pairs(verdicts, static_cast<std::size_t>(options.max_rejected_pairs));
    return drawn;
}

void add_judgements(DrawnMap& drawn, const std::vector<JudgedFrame>& frames)
{
    const auto truth_of = [](const JudgedFrame& frame)
    {
        if (frame.judgement == Judgement::right) return LoopTruthMark::right;
        return frame.judgement == Judgement::wrong ? LoopTruthMark::wrong : LoopTruthMark::doubtful;
    };
    for (auto& loop : drawn.loops) loop.truth = truth_of(frames.at(to_index(loop.query)));
    for (const auto& frame : frames)
        if (frame.loop_query && !frame.verdict.accepted())
            drawn.missed.push_back(frame.verdict.frame);
}

std::map<FrameId, DrawnCamera> cameras_of(const Map& map,
                                          const PlaceMap& places,
                                          const TRenderOptions& options)
{
    const auto& nodes = map.graph.nodes;
    std::map<FrameId, DrawnCamera> cameras;
    for (const auto i :
         spread_indices(static_cast<std::size_t>(options.max_map_cameras), nodes.size()))
    {
        const auto* place = places.find(nodes[i].frame);
        if (place == nullptr || !place->metric.camera) continue;
        const auto robot_from_camera = place->metric.robot_from_camera.value_or(RigidTransform());
        cameras[nodes[i].frame] = {
            rigid_transform_from(nodes[i].map_from_robot) * robot_from_camera,
            *place->metric.camera,
            {}};
    }
    return cameras;
}

std::vector<cv::Vec3d> true_way_over(const Map& map, const std::vector<PosedFrame>& truth)
{
    std::vector<TimedPose> trajectory;
    for (const auto& pose : map.optimized)
    {
        const auto map_from_robot = rigid_transform_from(pose.map_from_robot);
        trajectory.push_back(
            {pose.timestamp, {map_from_robot.rotation, map_from_robot.translation}});
    }
    std::vector<cv::Vec3d> way;
    for (const auto& frame : laid_over(trajectory, truth))
        if (frame.pose) way.push_back(frame.pose->position);
    return way;
}

void write_map_pictures(const DrawnMap& map,
                        const TRenderOptions& options,
                        const OutputFolder& folder)
{
    const MapScene scene(map, options);
    scene.save(folder.file("map.3Dscene"));
    if (interrupted()) return;
    write_picture(folder.file("map_top.png"), scene.draw_from_above().image);
    if (interrupted()) return;
    write_picture(folder.file("map_perspective.png"), scene.draw_in_perspective().image);
}

}  // namespace fild
