// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/loop_consistency.h"

namespace fild
{
LoopConsistency::LoopConsistency(const TDetectorOptions& options)
    : rows_(options.consistency),
      believable_log_odds_(believable_log_odds(options)),
      min_log_odds_(log_odds_of(options.same_place.min_probability))
{
    if (!options.consistency.belief) return;
    belief_.emplace(options.consistency);
    if (options.consistency.look_ahead_seconds > 0) smoother_.emplace(options.consistency);
}

void LoopConsistency::add_place(FrameId frame, std::size_t instant)
{
    if (belief_) belief_->add_place(frame, instant == last_place_instant_);
    last_place_instant_ = instant;
}

std::optional<FrameId> LoopConsistency::expected_place() const
{
    return belief_ ? belief_->likeliest() : std::nullopt;
}

void LoopConsistency::take(DetectorOutcome& outcome, std::size_t instant, const PlaceMap& places)
{
    auto& verdict = outcome.verdict;
    if (belief_)
    {
        std::vector<ComparedPlace> compared;
        for (const auto& entry : outcome.considered)
            if (entry.checked) compared.push_back({entry.candidate.frame, entry.odds});
        belief_->update(compared, instant != last_instant_);
        last_instant_ = instant;
        if (smoother_) smoother_->add(*belief_);
    }
    else if (!verdict.accepted())
        rows_.add_unverified(verdict.sensor_label);
    else if (!rows_.add_verified(verdict.sensor_label,
                                 places.at(verdict.candidate->frame).timestamp))
        verdict.rejection = Rejection::not_consistent_yet;
}

std::optional<BelievedCandidate> LoopConsistency::believed(const DetectorOutcome& outcome) const
{
    return belief_ ? most_believed(outcome, belief_->states()) : std::nullopt;
}

bool LoopConsistency::waits(const DetectorOutcome& outcome) const
{
    return smoother_ && !believable(outcome).empty();
}

std::optional<BelievedCandidate> LoopConsistency::believed_of_oldest(
    const DetectorOutcome& outcome) const
{
    return smoother_ ? most_believed(outcome, smoother_->oldest()) : std::nullopt;
}

void LoopConsistency::drop_oldest()
{
    if (smoother_) smoother_->drop_oldest();
}

void LoopConsistency::judge(const BelievedCandidate& believed, FrameVerdict& verdict) const
{
    verdict.support = believed.probability;
    if (log_odds_of(believed.probability) >= min_log_odds_)
        verdict.rejection = Rejection::none;
    else if (believed.entry.rejection == Rejection::none)
        verdict.rejection = Rejection::not_consistent_yet;
    else
        verdict.rejection = believed.entry.rejection;
}

std::vector<BelievableCandidate> LoopConsistency::believable(const DetectorOutcome& outcome) const
{
    std::vector<BelievableCandidate> candidates;
    for (const auto& entry : outcome.considered)
        if (entry.odds && entry.odds->log_odds() >= believable_log_odds_)
            candidates.push_back({&entry, belief_->place_of(entry.candidate.frame)});
    return candidates;
}

std::optional<BelievedCandidate> LoopConsistency::most_believed(const DetectorOutcome& outcome,
                                                                const PlaceStates& states) const
{
    const auto candidates = believable(outcome);
    if (candidates.empty()) return std::nullopt;
    return BelievedCandidate{most_probable(candidates, states),
                             probability_near(candidates, states)};
}

}  // namespace fild
