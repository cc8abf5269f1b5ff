// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/visual_odometry.h"

#include "fild/mapping/loop_edge.h"
#include "fild/mapping/motion_scale.h"
#include "fild/mapping/pair_poses.h"
#include "plausible_speed.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace fild
{
namespace
{
/** The camera with depths in the most frames (of equal ones the first by name); empty: none. */
std::optional<std::string> camera_with_depths(const PlaceMap& places, FrameId end)
{
    std::map<std::string, std::size_t> frames;
    for (std::uint64_t i = 0; i < to_index(end); ++i)
    {
        const auto* place = places.find(FrameId{i});
        if (place != nullptr && place->metric.depths.known() > 0) ++frames[place->sensor_label];
    }
    std::optional<std::string> best;
    for (const auto& [label, count] : frames)
        if (!best || count > frames.at(*best)) best = label;
    return best;
}

/** The frames of one camera that a pose can be had of. */
std::vector<FrameId> frames_of(const std::string& label, const PlaceMap& places, FrameId end)
{
    std::vector<FrameId> frames;
    for (std::uint64_t i = 0; i < to_index(end); ++i)
    {
        const auto* place = places.find(FrameId{i});
        if (place != nullptr && place->sensor_label == label && place->metric.camera)
            frames.push_back(FrameId{i});
    }
    return frames;
}

/** Motions between the frames of a list, by position in it. */
class FrameMotions
{
 public:
    FrameMotions(const PlaceMap& places,
                 const std::vector<FrameId>& frames,
                 const TDetectorOptions& options,
                 double max_speed_m_per_s)
        : places_(places),
          frames_(frames),
          poses_(without_doubt(options)),
          max_speed_m_per_s_(max_speed_m_per_s)
    {
    }

    std::optional<MeasuredMotion> between(std::size_t a, std::size_t b, StageTimes& times) const
    {
        return between(a, place(a).metric.depths, b, times);
    }

    /** With other depths of the earlier frame than its own. */
    std::optional<MeasuredMotion> between(std::size_t a,
                                          const KeypointDepths& depths,
                                          std::size_t b,
                                          StageTimes& times) const
    {
        const auto& candidate = place(a);
        const auto& query = place(b);
        const auto pose = poses_.estimate(query, query.metric.depths, candidate, depths, times);
        if (!pose.candidate_from_query) return std::nullopt;
        auto motion = robot_motion(*pose.candidate_from_query, candidate.metric, query.metric);
        const double elapsed = query.timestamp - candidate.timestamp;
        if (!motion ||
            (elapsed > 0 && is_too_fast(motion->a_from_b.norm(), elapsed, max_speed_m_per_s_)))
            return std::nullopt;
        return MeasuredMotion{
            frames_[a], frames_[b], candidate.timestamp, query.timestamp, *motion};
    }

 private:
    const Place& place(std::size_t i) const { return *places_.find(frames_[i]); }

    const PlaceMap& places_;
    const std::vector<FrameId>& frames_;
    PairPoses poses_;
    double max_speed_m_per_s_;
};

/** The frames' motions, one after the other. */
class Chain
{
 public:
    Chain(const FrameMotions& between,
          const PlaceMap& places,
          const std::vector<FrameId>& frames,
          const TDetectorOptions& options)
        : between_(between), places_(places), frames_(frames), options_(options)
    {
    }

    /** \param to_next  the motion from the frame before, if any. */
    void add(std::size_t i, std::optional<MeasuredMotion> to_next, StageTimes& times)
    {
        constexpr std::size_t kMaxLeftOut = 10;
        const auto left_out = i - last_ - 1;
        auto motion = left_out == 0 ? to_next : std::nullopt;
        if (!motion && left_out <= kMaxLeftOut) motion = over_those_left_out(i, times);
        // Where the frame does not fit over those that were left out either, but fits the one just
        // before, the chain begins anew.
        if (!motion) motion = std::move(to_next);
        if (!motion) return;
        motions_.push_back(*motion);
        last_ = i;
    }

    std::vector<MeasuredMotion> motions() && { return std::move(motions_); }

 private:
    std::optional<MeasuredMotion> over_those_left_out(std::size_t i, StageTimes& times)
    {
        if (last_ + 1 != i)
            if (auto motion = between_.between(last_, i, times)) return motion;
        const auto& depths = far_depths_of_last(times);
        if (depths.known() == 0) return std::nullopt;
        return between_.between(last_, depths, i, times);
    }

    /** As many as MotionScale looks back on. */
    std::vector<MeasuredMotion> latest_motions() const
    {
        constexpr std::size_t kMost = MotionScale::kMaxFrames;
        const auto count = static_cast<std::ptrdiff_t>(std::min(motions_.size(), kMost));
        return {motions_.end() - count, motions_.end()};
    }

    const KeypointDepths& far_depths_of_last(StageTimes& times)
    {
        auto& [depths, of] = far_depths_;
        if (of != last_)
        {
            const auto before = trajectory_from_motions(latest_motions());
            depths = MotionScale(places_, before, options_).depths_of(frames_[last_], times);
            of = last_;
        }
        return depths;
    }

    const FrameMotions& between_;
    const PlaceMap& places_;
    const std::vector<FrameId>& frames_;
    const TDetectorOptions& options_;
    std::vector<MeasuredMotion> motions_;
    std::size_t last_ = 0;
    std::pair<KeypointDepths, std::optional<std::size_t>> far_depths_;  ///< and of which frame
};
}  // namespace

std::vector<MeasuredMotion> visual_odometry(const PlaceMap& places,
                                            FrameId end,
                                            const TDetectorOptions& options,
                                            double max_speed_m_per_s,
                                            StageTimes& times,
                                            const CheckCancelled& check_cancelled)
{
    const StageTimer timer(times, "visual_odometry");
    const auto camera = camera_with_depths(places, end);
    if (!camera) return {};
    const auto frames = frames_of(*camera, places, end);
    if (frames.empty()) return {};
    const FrameMotions motions(places, frames, options, max_speed_m_per_s);
    std::vector<std::optional<MeasuredMotion>> to_next(frames.size() - 1);
    timed_parallel_for(options.runtime.num_threads,
                       to_next.size(),
                       times,
                       check_cancelled,
                       [&](std::size_t i, StageTimes& own_times)
                       { to_next[i] = motions.between(i, i + 1, own_times); });

    Chain chain(motions, places, frames, options);
    for (std::size_t i = 1; i < frames.size(); ++i)
    {
        check_cancelled();
        chain.add(i, std::move(to_next[i - 1]), times);
    }
    return std::move(chain).motions();
}

}  // namespace fild
