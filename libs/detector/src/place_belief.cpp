// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/place_belief.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace fild
{
namespace
{
constexpr double kLeastEvidence = -1.5;  // log-likelihood ratio of places that were not compared
constexpr double kWorthALook = 0.2;  // probability to be at a place of the map
constexpr double kLossPerPlace = 0.3;  // of the log-likelihood ratio, with the distance
}  // namespace

PlaceBelief::PlaceBelief(const TConsistencyOptions& options) : options_(options)
{
    options_.check();
}

void PlaceBelief::add_place(FrameId frame, bool is_last_place)
{
    if (is_last_place)
    {
        places_of_frames_.emplace(frame, frames_.size() - 1);
        return;
    }
    places_of_frames_.emplace(frame, frames_.size());
    frames_.push_back(frame);
    at_.same.push_back(0);
    at_.look_alike.push_back(0);
}

double PlaceBelief::update(const std::vector<ComparedPlace>& compared, bool has_moved)
{
    evidence_ = evidence_of(compared);
    evidence_.has_moved = has_moved;
    move(evidence_.entrances);
    at_ *= evidence_.likelihood;
    at_.normalize();
    return sum_of(at_.same);
}

void PlaceBelief::move(std::vector<Entrance>& entrances)
{
    const int step = evidence_.has_moved ? options_.place_step : 0;
    const double leaving = evidence_.has_moved ? options_.leave_probability : 0;
    auto same = spread(at_.same, step);
    auto look_alike = spread(at_.look_alike, step);
    const auto sums_of_same = running_sums(same);
    const double all_same = sums_of_same.back();
    const double all_look_alike = sum_of(look_alike);
    const double jump = entrances.empty() ? 0 : options_.jump_probability;
    const double entering = entrances.empty() ? 0 : options_.return_probability * at_.new_ground;
    const double stay = 1 - leaving - jump;
    for (auto& each : same) each *= stay;
    for (auto& each : look_alike) each *= stay;
    for (auto& [i, was_near] : entrances)
    {
        const auto share = 1 / static_cast<double>(entrances.size());
        was_near = sum_around(sums_of_same, i, options_.near_places);
        // A jump from far away may end at a look-alike, and so may a return from new ground, unless
        // the camera was near just before: then it has only lost sight of the place.
        const double from_near = (jump + entering) * was_near;
        const double from_far =
            entering * (1 - was_near) + jump * std::max(0.0, all_same - was_near);
        same[i] += share * ((1 - options_.look_alike_share) * from_far + from_near);
        look_alike[i] += share * (options_.look_alike_share * from_far + jump * all_look_alike);
    }
    at_.new_ground += leaving * (all_same + all_look_alike) - entering;
    at_.same = std::move(same);
    at_.look_alike = std::move(look_alike);
}

PlaceEvidence PlaceBelief::evidence_of(const std::vector<ComparedPlace>& compared) const
{
    const std::vector<double> not_compared(frames_.size(), std::exp(kLeastEvidence));
    PlaceEvidence evidence{true, {}, {1, not_compared, not_compared}};
    auto& [new_ground, same, look_alike] = evidence.likelihood;
    for (const auto& [frame, odds] : compared)
    {
        if (!odds) continue;
        const auto compared_place = place_of(frame);
        const auto leads_there = [&](const Entrance& each) { return each.place == compared_place; };
        auto& entrances = evidence.entrances;
        if (std::none_of(entrances.begin(), entrances.end(), leads_there))
            entrances.push_back({compared_place});
        const double against_look_alike = options_.look_alike_weight * odds->against_look_alike;
        const auto place = static_cast<long>(compared_place);
        const long last = std::min(place + kEvidenceReach, static_cast<long>(frames_.size()) - 1);
        for (long i = std::max(0L, place - kEvidenceReach); i <= last; ++i)
        {
            const auto k = static_cast<std::size_t>(i);
            const auto distance = static_cast<double>(std::abs(i - place));
            const double here = std::exp(odds->against_chance - kLossPerPlace * distance);
            if (here <= same[k]) continue;
            same[k] = here;
            look_alike[k] = here * std::exp(-against_look_alike);
        }
    }
    return evidence;
}

std::optional<FrameId> PlaceBelief::likeliest() const
{
    if (sum_of(at_.same) <= kWorthALook) return std::nullopt;
    const auto likeliest = std::max_element(at_.same.begin(), at_.same.end());
    return frames_[static_cast<std::size_t>(likeliest - at_.same.begin())];
}

}  // namespace fild
