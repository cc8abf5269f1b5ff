// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/candidate_choice.h"

#include "fild/detector/place_belief.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <tuple>

namespace fild
{
namespace
{
constexpr int kShownPlaces = 5;  // on either side of a candidate, that a frame at one may show

bool is_within(int reach, std::size_t a, std::size_t b)
{
    return std::abs(static_cast<long>(a) - static_cast<long>(b)) <= reach;
}
}  // namespace

double believable_log_odds(const TDetectorOptions& options)
{
    return log_odds_of(options.consistency.belief ? options.consistency.min_pair_probability
                                                  : options.same_place.min_probability);
}

bool is_better(const ConsideredCandidate& a, const ConsideredCandidate& b, double enough)
{
    const auto evidence = [enough](const ConsideredCandidate& each)
    {
        return each.odds ? std::min(each.odds->log_odds(), enough)
                         : -std::numeric_limits<double>::infinity();
    };
    return std::make_tuple(evidence(a), a.inliers, a.matches) >
           std::make_tuple(evidence(b), b.inliers, b.matches);
}

const ConsideredCandidate& most_probable(const std::vector<BelievableCandidate>& candidates,
                                         const PlaceStates& states)
{
    const auto likeliest =
        std::max_element(candidates.begin(),
                         candidates.end(),
                         [&](const BelievableCandidate& a, const BelievableCandidate& b)
                         { return states.same[a.place] < states.same[b.place]; });
    const auto* best = likeliest->entry;
    for (const auto& [entry, place] : candidates)
        if (is_within(kEvidenceReach, place, likeliest->place) && entry->inliers > best->inliers)
            best = entry;
    return *best;
}

double probability_near(const std::vector<BelievableCandidate>& candidates,
                        const PlaceStates& states)
{
    double sum = 0;
    for (std::size_t i = 0; i < states.same.size(); ++i)
        if (std::any_of(candidates.begin(),
                        candidates.end(),
                        [&](const BelievableCandidate& each)
                        { return is_within(kShownPlaces, each.place, i); }))
            sum += states.same[i];
    return sum;
}

}  // namespace fild
