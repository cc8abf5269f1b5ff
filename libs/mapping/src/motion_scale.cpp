// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/motion_scale.h"

#include "fild/geometry/motion_depths.h"
#include "fild/mapping/pair_poses.h"
#include "fild/rawlog/pose_conversion.h"

#include <cmath>
#include <utility>

namespace fild
{
namespace
{
bool are_one_camera(const Place& a, const Place& b)
{
    if (a.sensor_label != b.sensor_label || !a.metric.camera || !b.metric.camera) return false;
    const auto& p = *a.metric.camera;
    const auto& q = *b.metric.camera;
    return p.fx == q.fx && p.fy == q.fy && p.cx == q.cx && p.cy == q.cy && p.width == q.width &&
           p.height == q.height;
}

/** Relative standard deviation of the length of a movement. */
double length_deviation(const RelativeMotion& motion)
{
    const auto& pose = motion.a_from_b;
    const cv::Vec3d way(pose.x(), pose.y(), pose.z());
    const double squared_length = way.dot(way);
    double variance = 0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            variance += way[row] * motion.covariance(row, column) * way[column];
    return std::sqrt(variance) / squared_length;
}
}  // namespace

MotionScale::MotionScale(const PlaceMap& places,
                         const Trajectory& trajectory,
                         const TDetectorOptions& options)
    : places_(places),
      trajectory_(trajectory),
      pairs_(without_doubt(options)),
      options_(options.depth),
      enough_(static_cast<std::size_t>(options.relative_pose.min_points)),
      seed_(static_cast<std::uint64_t>(options.runtime.seed))
{
    options_.check();
}

KeypointDepths MotionScale::depths_of(FrameId frame, StageTimes& times) const
{
    auto best = best_of(frame, Direction::earlier, times);
    if (best.known() >= enough_) return best;
    auto later = best_of(frame, Direction::later, times);
    return later.known() > best.known() ? later : best;
}

KeypointDepths MotionScale::best_of(FrameId frame, Direction direction, StageTimes& times) const
{
    constexpr double kGrowth = 1.5;
    constexpr int kPatience = 2;  // others in a row that give no more depths
    KeypointDepths best;
    double least = options_.min_baseline_m;
    auto other = next(frame, direction);
    int not_better = 0;
    for (std::size_t i = 0; other && i < kMaxFrames && not_better < kPatience; ++i)
    {
        const auto motion = trajectory_.motion(*other, frame);
        const double baseline = motion ? motion->a_from_b.norm() : 0;
        if (baseline >= least)
        {
            least = kGrowth * baseline;
            auto depths = against(frame, *other, *motion, times);
            const bool is_better = depths.known() > best.known();
            not_better = is_better ? 0 : not_better + 1;
            if (is_better) best = std::move(depths);
        }
        other = next(*other, direction);
    }
    return best;
}

std::optional<FrameId> MotionScale::next(FrameId frame, Direction direction) const
{
    constexpr std::uint64_t kMaxOtherCameras = 16;
    const auto& label = places_.find(frame)->sensor_label;
    auto id = to_index(frame);
    for (std::uint64_t i = 0; i < kMaxOtherCameras; ++i)
    {
        if (direction == Direction::earlier && id == 0) return std::nullopt;
        id = direction == Direction::earlier ? id - 1 : id + 1;
        const auto* place = places_.find(FrameId{id});
        if (place != nullptr && place->sensor_label == label) return FrameId{id};
    }
    return std::nullopt;
}

KeypointDepths MotionScale::against(FrameId frame,
                                    FrameId other,
                                    const RelativeMotion& other_from_frame,
                                    StageTimes& times) const
{
    const auto& current = *places_.find(frame);
    const auto& earlier = *places_.find(other);
    if (!are_one_camera(current, earlier)) return {};
    const auto pair = pairs_.verify(current.local, earlier.local, times);
    if (pair.verification.rejection != Rejection::none) return {};
    const StageTimer timer(times, "motion_depth");
    const auto robot_from = [](const Place& place)
    { return place.metric.robot_from_camera.value_or(RigidTransform()); };
    return depths_from_motion(
        {*current.metric.camera,
         current.local.positions,
         earlier.local.positions,
         pair.inliers(),
         robot_from(earlier).inverse() * rigid_transform_from(other_from_frame.a_from_b) *
             robot_from(current),
         length_deviation(other_from_frame)},
        options_,
        seed_);
}

}  // namespace fild
