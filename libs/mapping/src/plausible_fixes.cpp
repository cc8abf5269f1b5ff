// SPDX-License-Identifier: BSD-3-Clause
#include "plausible_fixes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace fild
{
namespace
{
/** Numbers of fixes that follow one another at a plausible speed. */
using Track = std::vector<std::size_t>;

/** The least speed from one fix to a later one, when both are as wrong as they may be. */
double least_speed(const TimedFix& from, const TimedFix& to, const TGraphOptions& options)
{
    constexpr double kDeviations = 5;
    const cv::Vec3d way = EastNorthUp(from.fix.place).position_of(to.fix.place);
    const double distance = std::hypot(way[0], way[1], way[2] / kVerticalOfHorizontal);
    const double slack =
        kDeviations * (horizontal_sigma(from.fix, options) + horizontal_sigma(to.fix, options));
    const double elapsed = to.seconds - from.seconds;
    return std::max(0.0, distance - slack) / (elapsed > 0 ? elapsed : options.max_gap_s);
}

/** The track to go on with; nothing when none can be. Old tracks are not looked at: where most
 *  fixes are wrong there are as many tracks as fixes. */
std::optional<std::size_t> best_track(const std::vector<Track>& tracks,
                                      const std::vector<std::size_t>& latest,
                                      const std::vector<TimedFix>& fixes,
                                      std::size_t fix,
                                      const TGraphOptions& options)
{
    std::optional<std::size_t> best;
    double best_speed = options.max_speed_m_per_s;
    for (const auto each : latest)
    {
        const double speed = least_speed(fixes[tracks[each].back()], fixes[fix], options);
        const bool is_longer = best && tracks[each].size() > tracks[*best].size();
        if (speed > best_speed || (best && speed == best_speed && !is_longer)) continue;
        best = each;
        best_speed = speed;
    }
    return best;
}

std::vector<Track> tracks_of(const std::vector<TimedFix>& fixes, const TGraphOptions& options)
{
    constexpr std::size_t kLookedAt = 32;
    std::vector<Track> tracks;
    std::vector<std::size_t> latest;  // tracks, the one with the newest fix last
    for (std::size_t i = 0; i < fixes.size(); ++i)
    {
        const auto best = best_track(tracks, latest, fixes, i, options);
        const auto track = best.value_or(tracks.size());
        if (!best) tracks.emplace_back();
        tracks[track].push_back(i);
        latest.erase(std::remove(latest.begin(), latest.end(), track), latest.end());
        latest.push_back(track);
        if (latest.size() > kLookedAt) latest.erase(latest.begin());
    }
    return tracks;
}
}  // namespace

double horizontal_sigma(const GpsFix& fix, const TGraphOptions& options)
{
    switch (fix.quality)
    {
        case FixQuality::rtk_fixed:
            return options.gps_rtk_sigma_m * fix.hdop;
        case FixQuality::rtk_float:
            return options.gps_rtk_float_sigma_m * fix.hdop;
        case FixQuality::differential:
            return options.gps_differential_sigma_m * fix.hdop;
        case FixQuality::single:
            break;
    }
    return options.gps_sigma_m * fix.hdop;
}

std::vector<bool> plausible_fixes(const std::vector<TimedFix>& fixes, const TGraphOptions& options)
{
    constexpr std::size_t kEnoughFixes = 5;
    auto tracks = tracks_of(fixes, options);
    std::stable_sort(tracks.begin(),
                     tracks.end(),
                     [](const Track& a, const Track& b) { return a.size() > b.size(); });
    std::vector<const Track*> kept;
    for (const auto& track : tracks)
    {
        const auto is_apart = [&](const Track* other)
        { return track.back() < other->front() || track.front() > other->back(); };
        if (kept.empty() ||
            (track.size() >= kEnoughFixes && std::all_of(kept.begin(), kept.end(), is_apart)))
            kept.push_back(&track);
    }
    std::vector<bool> plausible(fixes.size(), false);
    for (const auto* track : kept)
        for (const auto i : *track) plausible[i] = true;
    return plausible;
}

}  // namespace fild
