// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/place_belief.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>

namespace fild
{
namespace
{
constexpr double kLeastEvidence = -1.5;  // log-likelihood ratio of places that were not compared
constexpr double kWorthALook = 0.2;  // probability to be at a place of the map
constexpr int kReach = 3;  // places on either side of a compared one to which its evidence applies
constexpr double kLossPerPlace = 0.3;  // of the log-likelihood ratio, with the distance

/** Sums of the first 0, 1, ... values. */
std::vector<double> running_sums(const std::vector<double>& values)
{
    std::vector<double> sums(values.size() + 1, 0);
    std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
    return sums;
}

/** Of the values within `reach` of the i-th on either side. */
double sum_around(const std::vector<double>& sums, std::size_t i, int reach)
{
    const auto step = static_cast<std::size_t>(reach);
    const auto end = std::min(sums.size() - 1, i + step + 1);
    return sums[end] - sums[i < step ? 0 : i - step];
}

/** Each place's belief spread evenly over those up to `step` before and after it. */
std::vector<double> spread(const std::vector<double>& belief, int step)
{
    const auto sums = running_sums(belief);
    std::vector<double> moved(belief.size());
    for (std::size_t i = 0; i < belief.size(); ++i)
        moved[i] = sum_around(sums, i, step) / (2 * step + 1);
    return moved;
}

double sum_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}
}  // namespace

PlaceBelief::PlaceBelief(const TConsistencyOptions& options) : options_(options)
{
    options_.check();
}

void PlaceBelief::add_place(FrameId frame)
{
    places_of_frames_.emplace(frame, frames_.size());
    frames_.push_back(frame);
    at_.same.push_back(0);
    at_.look_alike.push_back(0);
}

double PlaceBelief::update(const std::vector<ComparedPlace>& compared)
{
    std::vector<std::size_t> entrances;
    entrances.reserve(compared.size());
    for (const auto& place : compared) entrances.push_back(places_of_frames_.at(place.frame));
    move(entrances);
    weigh(compared);
    return sum_of_same();
}

void PlaceBelief::move(const std::vector<std::size_t>& entrances)
{
    auto same = spread(at_.same, options_.place_step);
    auto look_alike = spread(at_.look_alike, options_.place_step);
    const auto sums_of_same = running_sums(same);
    const double all_same = sums_of_same.back();
    const double all_look_alike = sum_of(look_alike);
    const double jump = entrances.empty() ? 0 : options_.jump_probability;
    const double entering = entrances.empty() ? 0 : options_.return_probability * new_ground_;
    const double stay = 1 - options_.leave_probability - jump;
    for (auto& each : same) each *= stay;
    for (auto& each : look_alike) each *= stay;
    for (const auto i : entrances)
    {
        const auto share = 1 / static_cast<double>(entrances.size());
        // A jump from far away may end at a look-alike, just as a return from new ground may.
        const double from_near = sum_around(sums_of_same, i, options_.near_places);
        const double from_far = entering + jump * std::max(0.0, all_same - from_near);
        same[i] += share * ((1 - options_.look_alike_share) * from_far + jump * from_near);
        look_alike[i] += share * (options_.look_alike_share * from_far + jump * all_look_alike);
    }
    new_ground_ += options_.leave_probability * (all_same + all_look_alike) - entering;
    at_ = {std::move(same), std::move(look_alike)};
}

void PlaceBelief::weigh(const std::vector<ComparedPlace>& compared)
{
    std::vector<double> same(frames_.size(), std::exp(kLeastEvidence));
    auto look_alike = same;
    for (const auto& [frame, odds] : compared)
    {
        if (!odds) continue;
        const double against_look_alike = options_.look_alike_weight * odds->against_look_alike;
        const auto place = static_cast<long>(places_of_frames_.at(frame));
        const long last = std::min(place + kReach, static_cast<long>(frames_.size()) - 1);
        for (long i = std::max(0L, place - kReach); i <= last; ++i)
        {
            const auto k = static_cast<std::size_t>(i);
            const auto distance = static_cast<double>(std::abs(i - place));
            const double here = std::exp(odds->against_chance - kLossPerPlace * distance);
            if (here <= same[k]) continue;
            same[k] = here;
            look_alike[k] = here * std::exp(-against_look_alike);
        }
    }
    std::transform(
        at_.same.begin(), at_.same.end(), same.begin(), at_.same.begin(), std::multiplies<>());
    std::transform(at_.look_alike.begin(),
                   at_.look_alike.end(),
                   look_alike.begin(),
                   at_.look_alike.begin(),
                   std::multiplies<>());
    const double total = sum_of(at_.same) + sum_of(at_.look_alike) + new_ground_;
    for (auto& each : at_.same) each /= total;
    for (auto& each : at_.look_alike) each /= total;
    new_ground_ /= total;
}

double PlaceBelief::sum_of_same() const
{
    return sum_of(at_.same);
}

std::optional<FrameId> PlaceBelief::likeliest() const
{
    if (sum_of_same() <= kWorthALook) return std::nullopt;
    const auto likeliest = std::max_element(at_.same.begin(), at_.same.end());
    return frames_[static_cast<std::size_t>(likeliest - at_.same.begin())];
}

}  // namespace fild
