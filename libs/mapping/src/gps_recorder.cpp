// SPDX-License-Identifier: BSD-3-Clause
#include "gps_recorder.h"

#include "fild/core/upper_median.h"
#include "sensor_name.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace fild
{
namespace
{
/** Fixes that a receiver had, and how good they are. */
struct RatedReceiver
{
    const GpsReceiver* receiver;
    const std::vector<AwaitedFrame>* frames;
    std::vector<bool> plausible;
    double median_sigma = std::numeric_limits<double>::infinity();
};

double median_sigma(const std::vector<TimedFix>& fixes, const TGraphOptions& options)
{
    if (fixes.empty()) return std::numeric_limits<double>::infinity();
    std::vector<double> sigmas;
    sigmas.reserve(fixes.size());
    for (const auto& each : fixes) sigmas.push_back(horizontal_sigma(each.fix, options));
    return upper_median(std::move(sigmas));
}

/** The first plausible fix of all, in the order of the receivers. */
GeodeticPosition origin_of(const std::vector<RatedReceiver>& rated)
{
    for (const auto& each : rated)
        for (std::size_t i = 0; i < each.plausible.size(); ++i)
            if (each.plausible[i]) return each.receiver->fixes()[i].fix.place;
    return {};
}
}  // namespace

void GpsRecorder::feed(const mrpt::obs::CObservation& observation)
{
    if (!is_gps(observation)) return;
    const auto name = name_of(observation);
    auto found = sensors_.find(name);
    if (found == sensors_.end())
        found = sensors_.emplace(name, Sensor{GpsReceiver(name, options_), frames_}).first;
    found->second.receiver.feed(observation);
}

void GpsRecorder::add_frame(FrameId frame, double timestamp)
{
    frames_.push_back({frame, timestamp, 0});
    for (auto& [name, sensor] : sensors_)
        sensor.frames.push_back({frame, timestamp, sensor.receiver.fixes().size()});
}

GpsRecord GpsRecorder::build() const
{
    std::vector<RatedReceiver> rated;
    for (const auto& [name, sensor] : sensors_)
    {
        const auto& fixes = sensor.receiver.fixes();
        rated.push_back({&sensor.receiver,
                         &sensor.frames,
                         plausible_fixes(fixes, options_),
                         median_sigma(fixes, options_)});
    }
    std::stable_sort(rated.begin(),
                     rated.end(),
                     [](const RatedReceiver& a, const RatedReceiver& b)
                     { return a.median_sigma < b.median_sigma; });
    GpsRecord record;
    record.origin = origin_of(rated);
    const EastNorthUp map(record.origin);
    for (const auto& each : rated)
        record.tracks.push_back(each.receiver->track(each.plausible, map, *each.frames));
    return record;
}

}  // namespace fild
