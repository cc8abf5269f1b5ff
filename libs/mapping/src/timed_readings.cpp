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

/** Before the first and after the last reading the robot moves on as it did, for as long as one
 *  reading is from the next. Nothing further away, or in a gap.
 *  \param run  among `readings`. \param is_cut  the run began with readings that are forgotten. */
std::optional<FoundPose> pose_in_run(const std::vector<TimedReading>& readings,
                                     ClockRun run,
                                     bool is_cut,
                                     double seconds,
                                     double max_gap)
{
    constexpr double kSameMoment = 0.1;  // s
    const auto alone = [&](std::size_t i) -> std::optional<FoundPose>
    {
        if (std::abs(readings[i].seconds - seconds) > kSameMoment) return std::nullopt;
        return FoundPose{readings[i].at, i};
    };
    if (is_cut && seconds < readings[run.begin].seconds) return std::nullopt;
    if (run.end - run.begin == 1) return alone(run.begin);
    const auto i = reading_before(readings, run, seconds);
    const auto& a = readings[i];
    const auto& b = readings[i + 1];
    const double interval = b.seconds - a.seconds;
    if (interval > max_gap || a.at.segment != b.at.segment)
        return alone(seconds - a.seconds < b.seconds - seconds ? i : i + 1);
    const double share = (seconds - a.seconds) / interval;
    if (share < -1 || share > 2) return std::nullopt;
    return FoundPose{between(a.at, b.at, share), share > 1 ? i + 1 : i};
}
}  // namespace

std::optional<FoundPose> pose_at(const KeptReadings& kept,
                                 const AwaitedFrame& frame,
                                 double max_gap_s,
                                 std::optional<FoundPose> best,
                                 std::size_t last)
{
    const auto distance = [&](const FoundPose& found)
    {
        return found.reading > frame.arrival ? found.reading - frame.arrival
                                             : frame.arrival - found.reading;
    };
    for (const auto& run : kept.runs)
    {
        if (run.end <= kept.forgotten) continue;
        const bool is_cut = run.begin < kept.forgotten;
        const ClockRun left{is_cut ? 0 : run.begin - kept.forgotten, run.end - kept.forgotten};
        auto found = pose_in_run(kept.readings, left, is_cut, frame.timestamp, max_gap_s);
        if (!found) continue;
        found->reading += kept.forgotten;
        if (found->reading > last) continue;
        if (!best || distance(*found) < distance(*best)) best = std::move(found);
    }
    return best;
}

}  // namespace fild
