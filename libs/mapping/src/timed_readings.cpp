// SPDX-License-Identifier: BSD-3-Clause
#include "timed_readings.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fild
{
namespace
{
UncertainPose between(const UncertainPose& a, const UncertainPose& b, double share)
{
    UncertainPose result = b;
    result.map_from_robot = between(a.map_from_robot, b.map_from_robot, share);
    result.accumulated = a.accumulated + share * (b.accumulated - a.accumulated);
    const double inside = std::clamp(share, 0.0, 1.0);
    if (a.absolute && b.absolute)
        result.absolute = *a.absolute + inside * (*b.absolute - *a.absolute);
    return result;
}

/** Of readings with growing times, those around a time: the first of the two. */
std::size_t reading_before(const std::vector<TimedReading>& readings, ClockRun run, double seconds)
{
    const auto begin = readings.begin() + static_cast<std::ptrdiff_t>(run.begin);
    const auto end = readings.begin() + static_cast<std::ptrdiff_t>(run.end);
    const auto after = std::upper_bound(begin,
                                        end,
                                        seconds,
                                        [](double wanted, const TimedReading& each)
                                        { return wanted < each.seconds; });
    const auto last = end - 1;
    return static_cast<std::size_t>((after == begin ? begin : std::min(after, last) - 1) -
                                    readings.begin());
}

/** The pose at a time of a run of readings, and the reading that is next to it. */
struct Found
{
    UncertainPose at;
    std::size_t reading = 0;
};

/** Before the first and after the last reading the robot moves on as it did, for as long as one
 *  reading is from the next. Nothing further away, or in a gap. */
std::optional<Found> pose_in_run(const std::vector<TimedReading>& readings,
                                 ClockRun run,
                                 double seconds,
                                 double max_gap)
{
    constexpr double kSameMoment = 0.1;  // s
    const auto alone = [&](std::size_t i) -> std::optional<Found>
    {
        if (std::abs(readings[i].seconds - seconds) > kSameMoment) return std::nullopt;
        return Found{readings[i].at, i};
    };
    if (run.end - run.begin == 1) return alone(run.begin);
    const auto i = std::max(run.begin, reading_before(readings, run, seconds));
    const auto& a = readings[i];
    const auto& b = readings[i + 1];
    const double interval = b.seconds - a.seconds;
    if (interval > max_gap || a.at.segment != b.at.segment)
        return alone(seconds - a.seconds < b.seconds - seconds ? i : i + 1);
    const double share = (seconds - a.seconds) / interval;
    if (share < -1 || share > 2) return std::nullopt;
    return Found{between(a.at, b.at, share), share > 1 ? i + 1 : i};
}
}  // namespace

Rigid between(const Rigid& a, const Rigid& b, double share)
{
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(a.rotation).slerp(share, Eigen::Quaterniond(b.rotation));
    return {turn.normalized().toRotationMatrix(),
            a.translation + share * (b.translation - a.translation)};
}

std::optional<UncertainPose> pose_at(const std::vector<TimedReading>& readings,
                                     const std::vector<ClockRun>& runs,
                                     const AwaitedFrame& frame,
                                     double max_gap_s)
{
    std::optional<Found> best;
    const auto distance = [&](const Found& found)
    {
        return found.reading > frame.arrival ? found.reading - frame.arrival
                                             : frame.arrival - found.reading;
    };
    for (const auto& run : runs)
    {
        auto found = pose_in_run(readings, run, frame.timestamp, max_gap_s);
        if (found && (!best || distance(*found) < distance(*best))) best = std::move(found);
    }
    if (!best) return std::nullopt;
    return best->at;
}

}  // namespace fild
