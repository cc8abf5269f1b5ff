// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_truth.h"

#include "fild/core/angle.h"

#include <algorithm>
#include <utility>

namespace fild
{
namespace
{
bool are_near(const FramePose& a, const FramePose& b, double radius, double max_angle_deg)
{
    return cv::norm(a.position - b.position) <= radius &&
           angle_between(a, b) <= max_angle_deg * kRadiansPerDegree;
}
}  // namespace

LabelTruth::LabelTruth(LoopLabels labels, std::size_t window)
    : labels_(std::move(labels)), window_(window)
{
}

bool LabelTruth::is_loop_query(FrameId query) const
{
    return labels_.earlier_frames.count(to_index(query)) > 0;
}

Judgement LabelTruth::judge(FrameId query, FrameId candidate) const
{
    const bool doubtful = labels_.doubtful.count({to_index(query), to_index(candidate)}) > 0;
    const auto otherwise = doubtful ? Judgement::neither : Judgement::wrong;
    const auto labelled = labels_.earlier_frames.find(to_index(query));
    if (labelled == labels_.earlier_frames.end()) return otherwise;
    const auto& frames = labelled->second;
    const auto column = to_index(candidate);
    const auto first = column < window_ ? 0 : column - window_;
    const auto near = std::lower_bound(frames.begin(), frames.end(), first);
    return near != frames.end() && *near <= column + window_ ? Judgement::right : otherwise;
}

PoseTruth::PoseTruth(std::vector<PosedFrame> frames, const Protocol& protocol)
    : frames_(std::move(frames)), protocol_(protocol)
{
}

bool PoseTruth::is_loop_query(FrameId query) const
{
    for (std::size_t i = 0; i < to_index(query); ++i)
        if (judge(query, FrameId{i}) == Judgement::right) return true;
    return false;
}

Judgement PoseTruth::judge(FrameId query, FrameId candidate) const
{
    const auto& now = frames_.at(to_index(query));
    const auto& then = frames_.at(to_index(candidate));
    if (!now.pose || !then.pose) return Judgement::neither;
    const auto within = [&](double radius, double max_angle_deg)
    { return are_near(*now.pose, *then.pose, radius, max_angle_deg); };
    if (!within(protocol_.radius, protocol_.max_angle_deg))
    {
        const bool is_doubtful = protocol_.doubtful_radius > 0 &&
                                 within(protocol_.doubtful_radius, 2 * protocol_.max_angle_deg);
        return is_doubtful ? Judgement::neither : Judgement::wrong;
    }
    const bool old_enough = now.timestamp - then.timestamp >= protocol_.min_age_seconds;
    return old_enough ? Judgement::right : Judgement::neither;
}

}  // namespace fild
