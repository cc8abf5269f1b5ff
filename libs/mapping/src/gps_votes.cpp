// SPDX-License-Identifier: BSD-3-Clause
#include "gps_votes.h"

#include "fild/core/upper_median.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fild
{
namespace
{
/** The position before a frame in the order of the recording, when it is not old. */
const GpsPosition* latest(const GpsTrack& track, std::size_t frame)
{
    constexpr double kOldest = 1.5;  // s
    const auto& [id, timestamp, arrival] = track.frames[frame];
    if (arrival == 0) return nullptr;
    const auto& position = track.positions[arrival - 1];
    return std::abs(position.seconds - timestamp) <= kOldest ? &position : nullptr;
}

/** Nothing when the two have not enough positions at the same times. */
std::optional<bool> agree(const GpsTrack& one, const GpsTrack& other)
{
    constexpr std::size_t kEnough = 5;
    constexpr double kDeviations = 4;
    constexpr double kSameTime = 0.2;  // s
    constexpr double kSlack = 1;  // m: the robot moves between the two
    std::vector<double> excesses;
    for (std::size_t frame = 0; frame < one.frames.size(); ++frame)
    {
        const auto* a = latest(one, frame);
        const auto* b = latest(other, frame);
        if (a == nullptr || b == nullptr || std::abs(a->seconds - b->seconds) > kSameTime) continue;
        const double apart = (a->map_from_antenna - b->map_from_antenna).head<2>().norm();
        const double antennas = (a->robot_from_antenna - b->robot_from_antenna).norm();
        excesses.push_back(apart - antennas - kSlack -
                           kDeviations * std::hypot(a->sigma_m, b->sigma_m));
    }
    if (excesses.size() < kEnough) return std::nullopt;
    return upper_median(std::move(excesses)) <= 0;
}
}  // namespace

std::vector<bool> contradicted_tracks(const std::vector<GpsTrack>& tracks)
{
    std::vector<int> votes(tracks.size(), 0);
    std::vector<bool> contradicted(tracks.size(), false);
    for (std::size_t i = 0; i < tracks.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
        {
            const auto same = agree(tracks[i], tracks[j]);
            if (!same) continue;
            votes[i] += *same ? 1 : -1;
            votes[j] += *same ? 1 : -1;
            if (tracks.size() == 2 && !*same) contradicted[i] = true;
        }
    if (tracks.size() > 2)
        std::transform(
            votes.begin(), votes.end(), contradicted.begin(), [](int vote) { return vote < 0; });
    return contradicted;
}

}  // namespace fild
