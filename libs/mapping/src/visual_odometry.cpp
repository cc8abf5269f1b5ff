// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/visual_odometry.h"

#include "fild/mapping/loop_edge.h"
#include "fild/mapping/pair_poses.h"

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace fild
{
namespace
{
/** The camera with depths in the most frames (of equal ones the first by name); empty: none. */
std::optional<std::string> camera_with_depths(const LoopDetector& detector, FrameId end)
{
    std::map<std::string, std::size_t> frames;
    for (std::uint64_t i = 0; i < to_index(end); ++i)
    {
        const auto* place = detector.find_place(FrameId{i});
        if (place != nullptr && place->metric.depths.known() > 0) ++frames[place->sensor_label];
    }
    std::optional<std::string> best;
    for (const auto& [label, count] : frames)
        if (!best || count > frames.at(*best)) best = label;
    return best;
}

/** The frames of one camera that a pose can be had of. */
std::vector<FrameId> frames_of(const std::string& label, const LoopDetector& detector, FrameId end)
{
    std::vector<FrameId> frames;
    for (std::uint64_t i = 0; i < to_index(end); ++i)
    {
        const auto* place = detector.find_place(FrameId{i});
        if (place != nullptr && place->sensor_label == label && place->metric.camera)
            frames.push_back(FrameId{i});
    }
    return frames;
}

/** Motions between the frames of a list, by position in it. */
class FrameMotions
{
 public:
    FrameMotions(const LoopDetector& detector,
                 const std::vector<FrameId>& frames,
                 const TDetectorOptions& options)
        : detector_(detector), frames_(frames), poses_(without_doubt(options))
    {
    }

    std::optional<MeasuredMotion> between(std::size_t a, std::size_t b, StageTimes& times) const
    {
        const auto& candidate = *detector_.find_place(frames_[a]);
        const auto& query = *detector_.find_place(frames_[b]);
        const auto pose =
            poses_.estimate(query, query.metric.depths, candidate, candidate.metric.depths, times);
        if (!pose.candidate_from_query) return std::nullopt;
        auto motion = robot_motion(*pose.candidate_from_query, candidate.metric, query.metric);
        if (!motion) return std::nullopt;
        return MeasuredMotion{
            frames_[a], frames_[b], candidate.timestamp, query.timestamp, *motion};
    }

 private:
    const LoopDetector& detector_;
    const std::vector<FrameId>& frames_;
    PairPoses poses_;
};
}  // namespace

std::vector<MeasuredMotion> visual_odometry(const LoopDetector& detector,
                                            FrameId end,
                                            const TDetectorOptions& options,
                                            StageTimes& times)
{
    constexpr std::size_t kMaxLeftOut = 10;
    const StageTimer timer(times, "visual_odometry");
    const auto camera = camera_with_depths(detector, end);
    if (!camera) return {};
    const auto frames = frames_of(*camera, detector, end);
    const FrameMotions motions(detector, frames, options);
    std::vector<std::optional<MeasuredMotion>> to_next(frames.size() - 1);
    timed_parallel_for(options.runtime.num_threads,
                       to_next.size(),
                       times,
                       [&](std::size_t i, StageTimes& own_times)
                       { to_next[i] = motions.between(i, i + 1, own_times); });

    std::vector<MeasuredMotion> chain;
    std::size_t last = 0;
    for (std::size_t i = 1; i < frames.size(); ++i)
    {
        auto motion = to_next[i - 1];
        // Where frames were left out and this one does not fit over them either, but fits the one
        // just before, the chain begins anew.
        if (last + 1 != i && i - last <= kMaxLeftOut + 1)
            if (auto over_them = motions.between(last, i, times)) motion = std::move(over_them);
        if (!motion) continue;
        chain.push_back(*motion);
        last = i;
    }
    return chain;
}

}  // namespace fild
