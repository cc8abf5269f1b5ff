// SPDX-License-Identifier: BSD-3-Clause
// Forward-backward smoothing: Rabiner, "A tutorial on hidden Markov models", Proc. IEEE 1989,
// III-A.
#include "fild/detector/place_smoother.h"

namespace fild
{
PlaceSmoother::PlaceSmoother(const TConsistencyOptions& options) : options_(options)
{
    options_.check();
}

void PlaceSmoother::add(const PlaceBelief& belief)
{
    window_.push_back({belief.states(), belief.evidence()});
}

PlaceStates PlaceSmoother::oldest() const
{
    auto states = window_.front().belief;
    if (window_.size() == 1) return states;
    const auto& newest = window_.back().evidence.likelihood;
    PlaceStates later{1,
                      std::vector<double>(newest.same.size(), 1),
                      std::vector<double>(newest.look_alike.size(), 1)};
    for (auto frame = window_.rbegin(); frame + 1 != window_.rend(); ++frame)
    {
        later *= frame->evidence.likelihood;
        later = move_back(later, frame->evidence);
        later.normalize();
        // Places that came into the map with this frame: the camera was at none of them before.
        const auto places = (frame + 1)->evidence.likelihood.same.size();
        later.same.resize(places);
        later.look_alike.resize(places);
    }
    states *= later;
    states.normalize();
    return states;
}

/** What is to come, as seen from each state before the move: the transpose of PlaceBelief::move(),
 *  but for jumps from a look-alike. Those may end at the place, too: else a clear return would
 *  vouch for all that was taken for a place anywhere before it. */
PlaceStates PlaceSmoother::move_back(const PlaceStates& later, const PlaceEvidence& evidence) const
{
    const auto& entrances = evidence.entrances;
    const int step = evidence.has_moved ? options_.place_step : 0;
    const double leave = evidence.has_moved ? options_.leave_probability : 0;
    const double jump = entrances.empty() ? 0 : options_.jump_probability;
    const double entering = entrances.empty() ? 0 : options_.return_probability;
    const double stay = 1 - leave - jump;
    const double look_alike_share = options_.look_alike_share;

    double from_far = 0;  // what comes of a jump from far away
    double from_new_ground = 0;  // of a return
    std::vector<double> gains(later.same.size(), 0);  // of a jump from near over one from far away
    for (const auto& [i, was_near] : entrances)
    {
        const auto share = 1 / static_cast<double>(entrances.size());
        gains[i] = share * look_alike_share * (later.same[i] - later.look_alike[i]);
        from_far += share * later.same[i] - gains[i];
        from_new_ground += share * later.same[i] - gains[i] * (1 - was_near);
    }

    PlaceStates before = later;
    const double leaving = leave * later.new_ground;
    const auto sums_of_gains = running_sums(gains);
    for (std::size_t i = 0; i < later.same.size(); ++i)
    {
        const double gain = sum_around(sums_of_gains, i, options_.near_places);
        before.same[i] = stay * later.same[i] + leaving + jump * (from_far + gain);
        before.look_alike[i] = stay * later.look_alike[i] + leaving + jump * from_far;
    }
    before.same = spread(before.same, step);
    before.look_alike = spread(before.look_alike, step);
    before.new_ground = (1 - entering) * later.new_ground + entering * from_new_ground;
    return before;
}

}  // namespace fild
