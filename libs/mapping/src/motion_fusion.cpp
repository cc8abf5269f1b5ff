// SPDX-License-Identifier: BSD-3-Clause
#include "motion_fusion.h"

#include "fild/graph/uncertain_motion.h"
#include "timed_readings.h"

#include <mrpt/math/distributions.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace fild
{
namespace
{
std::optional<UncertainMotion> scaled_motion(const Trajectory& trajectory,
                                             FrameId a,
                                             FrameId b,
                                             double variance_scale)
{
    const auto motion = trajectory.motion(a, b);
    if (!motion) return std::nullopt;
    auto uncertain = to_uncertain(*motion);
    uncertain.covariance *= variance_scale;
    return uncertain;
}

/** Weighted mean of two measurements of one motion. */
UncertainMotion mean_of(UncertainMotion one, UncertainMotion other, bool& contradict)
{
    constexpr double kConfidence = 0.999;
    const double limit = mrpt::math::chi2inv(kConfidence, 6);
    const Vector6 difference = tangent_of(one.motion.inverse() * other.motion);
    Matrix6 sum = one.covariance + other.covariance;
    contradict = difference.dot(sum.ldlt().solve(difference)) > limit;
    if (contradict)
    {
        // Either may be wrong by all of it: wheels that slip, or that stand still for the odometry.
        const Matrix6 doubt = difference * difference.transpose();
        one.covariance += doubt;
        other.covariance += doubt;
        sum = one.covariance + other.covariance;
    }
    const Matrix6 gain = sum.ldlt().solve(one.covariance).transpose();
    const Matrix6 rest = Matrix6::Identity() - gain;
    const Matrix6 covariance =
        rest * one.covariance * rest.transpose() + gain * other.covariance * gain.transpose();
    return {one.motion * rigid_of(gain * difference), covariance};
}

/** Puts the motions together, step by step. */
class Fusion
{
 public:
    Fusion(const Trajectory& odometry,
           double odometry_scale,
           const Trajectory& vision,
           double vision_scale)
        : odometry_(odometry),
          vision_(vision),
          odometry_scale_(odometry_scale),
          vision_scale_(vision_scale)
    {
        for (const auto* trajectory : {&odometry, &vision})
            for (const auto& pose : trajectory->poses()) frames_[pose.frame] = pose.timestamp;
    }

    FusedMotion run()
    {
        for (auto frame = frames_.begin(); frame != frames_.end();)
        {
            const auto end = end_of_image_motion(frame->first);
            const auto next = end ? frames_.find(*end) : std::next(frame);
            if (next == frames_.end()) break;
            if (end)
                add_by_images(frame->first, *end);
            else if (const auto motion = by_odometry(frame->first, next->first))
            {
                ++fused_.from_odometry;
                add(frame->first, next->first, *motion);
            }
            frame = next;
        }
        return std::move(fused_);
    }

 private:
    std::optional<UncertainMotion> by_odometry(FrameId a, FrameId b) const
    {
        return scaled_motion(odometry_, a, b, odometry_scale_);
    }

    /** The next frame of the images' chain, when a motion leads to it. */
    std::optional<FrameId> end_of_image_motion(FrameId frame) const
    {
        const auto& poses = vision_.poses();
        const auto after = std::upper_bound(poses.begin(),
                                            poses.end(),
                                            frame,
                                            [](FrameId wanted, const TrajectoryPose& pose)
                                            { return wanted < pose.frame; });
        if (after == poses.end() || !vision_.motion(frame, after->frame)) return std::nullopt;
        return after->frame;
    }

    void add_by_images(FrameId a, FrameId b)
    {
        const auto seen = *scaled_motion(vision_, a, b, vision_scale_);
        const auto driven = by_odometry(a, b);
        if (!driven)
        {
            ++fused_.from_images;
            add(a, b, seen);
            return;
        }
        bool contradict = false;
        const auto mean = mean_of(*driven, seen, contradict);
        ++fused_.from_both;
        fused_.contradictions += contradict ? 1 : 0;
        add_over_frames_between(a, b, driven->motion, mean);
    }

    /** Each frame between takes over its share of the correction, by number. */
    void add_over_frames_between(FrameId a,
                                 FrameId b,
                                 const Rigid& driven,
                                 const UncertainMotion& mean)
    {
        const Rigid correction = driven.inverse() * mean.motion;
        const auto begin = frames_.find(a);
        const auto end = frames_.find(b);
        const auto steps = static_cast<double>(std::distance(begin, end));
        Rigid before;
        auto last = begin;
        double taken = 0;
        for (auto frame = std::next(begin); frame != end; ++frame)
        {
            const auto motion = odometry_.motion(a, frame->first);
            if (!motion) continue;
            const double share = static_cast<double>(std::distance(begin, frame)) / steps;
            const Rigid here = to_rigid(motion->a_from_b) * between(Rigid(), correction, share);
            add(last->first,
                frame->first,
                {before.inverse() * here, (share - taken) * mean.covariance});
            before = here;
            last = frame;
            taken = share;
        }
        add(last->first, b, {before.inverse() * mean.motion, (1 - taken) * mean.covariance});
    }

    void add(FrameId a, FrameId b, const UncertainMotion& motion)
    {
        fused_.motions.push_back({a, b, frames_.at(a), frames_.at(b), to_relative(motion)});
    }

    const Trajectory& odometry_;
    const Trajectory& vision_;
    double odometry_scale_;
    double vision_scale_;
    std::map<FrameId, double> frames_;  ///< time stamps
    FusedMotion fused_;
};
}  // namespace

double length_ratio(const Trajectory& odometry, const Trajectory& vision)
{
    constexpr double kMoved = 0.05;  // m
    double driven = 0;
    double seen = 0;
    const auto& poses = vision.poses();
    for (std::size_t i = 1; i < poses.size(); ++i)
    {
        const auto by_wheels = odometry.motion(poses[i - 1].frame, poses[i].frame);
        const auto by_images = vision.motion(poses[i - 1].frame, poses[i].frame);
        if (!by_wheels || !by_images) continue;
        const double one = by_wheels->a_from_b.norm();
        const double other = by_images->a_from_b.norm();
        if (std::max(one, other) < kMoved) continue;
        driven += one;
        seen += other;
    }
    return seen > 0 ? driven / seen : 1;
}

FusedMotion fused_motion(const Trajectory& odometry,
                         double odometry_variance_scale,
                         const Trajectory& vision,
                         double vision_variance_scale)
{
    return Fusion(odometry, odometry_variance_scale, vision, vision_variance_scale).run();
}

}  // namespace fild
