// SPDX-License-Identifier: BSD-3-Clause
// The FILD pipeline (An et al., IROS 2019), Figure 2.
#include "fild/detector/loop_detector.h"

#include "fild/matching/cell_motion.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
constexpr std::size_t kToldAnswers = 10;  // that candidates.csv has, verified or not

FrameVerdict verdict_of(const FrameDescription& description, Rejection rejection)
{
    FrameVerdict verdict;
    verdict.frame = description.frame;
    verdict.timestamp = description.timestamp;
    verdict.sensor_label = description.sensor_label;
    verdict.keypoints = description.local.positions.size();
    verdict.rejection = rejection;
    return verdict;
}

/** The explanation that the evidence does not rule out. */
Rejection weakness_of(const PairOdds& odds)
{
    return odds.against_chance < odds.against_look_alike ? Rejection::may_be_chance
                                                         : Rejection::may_be_look_alike;
}

std::size_t instants_between(const Place& a, const Place& b)
{
    return std::max(a.instant, b.instant) - std::min(a.instant, b.instant);
}

std::size_t bytes_of(const HashedFeatures& features)
{
    return features.positions.size() * sizeof(PixelPosition) +
           features.codes.words.size() * sizeof(std::uint64_t) +
           features.codes.buckets.size() * sizeof(std::uint16_t) +
           features.cells.codes.words.size() * sizeof(std::uint64_t);
}

std::size_t bytes_of(const KeypointDepths& depths)
{
    return (depths.metres.size() + depths.deviations_m.size()) * sizeof(float);
}
}  // namespace

/** The candidates of one query: what the index answered, which were verified, and the best. Equals
 *  stay in the order of the search, most similar first. */
class LoopDetector::Trials
{
 public:
    Trials(const LoopDetector& detector,
           const FrameDescription& query,
           const std::vector<Candidate>& answers,
           StageTimes& times)
        : detector_(detector), query_(query), times_(times)
    {
        for (const auto& answer : answers) considered_.push_back({answer, considered_.size() + 1});
    }

    /** \return true when the candidate is the best so far; false for one that was verified before.
     */
    bool verify(const Candidate& candidate)
    {
        auto& entry = entry_of(candidate);
        if (entry.checked) return false;
        DetectorOutcome outcome{verdict_of(query_, Rejection::none), {}, {}, {}};
        detector_.verify(query_.local, entry, outcome, times_);
        convinces_ = convinces_ || outcome.verdict.accepted();
        if (best_ && !is_better(entry, best_entry_, detector_.believable_log_odds_)) return false;
        best_ = std::move(outcome);
        best_entry_ = entry;
        return true;
    }

    /** The best so far; null when none was verified. */
    const FrameVerdict* best() const { return best_ ? &best_->verdict : nullptr; }

    /** True when a candidate that was verified would be accepted for itself. */
    bool convinces() const { return convinces_; }

    /** With no candidate verified, the most similar one is named as too unlike. */
    DetectorOutcome outcome() &&
    {
        if (!best_)
        {
            best_ = DetectorOutcome{verdict_of(query_, Rejection::below_similarity), {}, {}, {}};
            best_->verdict.candidate = considered_.front().candidate;
        }
        best_->considered = told();
        return std::move(*best_);
    }

 private:
    /** The nearest answers, and whatever else was verified. */
    std::vector<ConsideredCandidate> told()
    {
        const auto is_left_out = [](const ConsideredCandidate& entry)
        { return !entry.checked && entry.rank > kToldAnswers; };
        considered_.erase(std::remove_if(considered_.begin(), considered_.end(), is_left_out),
                          considered_.end());
        return std::move(considered_);
    }

    ConsideredCandidate& entry_of(const Candidate& candidate)
    {
        for (auto& entry : considered_)
            if (entry.candidate.frame == candidate.frame) return entry;
        considered_.push_back({candidate});
        return considered_.back();
    }

    const LoopDetector& detector_;
    const FrameDescription& query_;
    StageTimes& times_;
    std::vector<ConsideredCandidate> considered_;
    std::optional<DetectorOutcome> best_;
    ConsideredCandidate best_entry_;  ///< of `best_`
    bool convinces_ = false;
};

LoopDetector::LoopDetector(const TDetectorOptions& options, std::size_t global_dimension)
    : global_dimension_(global_dimension),
      index_options_(options.index),
      candidate_options_(options.candidates),
      estimates_poses_(options.relative_pose.enabled),
      min_inliers_(static_cast<std::size_t>(options.verification.min_inliers)),
      queue_(options.index),
      index_(make_place_index(
          options.index, global_dimension, static_cast<std::uint64_t>(options.runtime.seed))),
      pairs_(options),
      poses_(options.relative_pose, static_cast<std::uint64_t>(options.runtime.seed)),
      consistency_(options.consistency),
      waiting_(options),
      standstill_(options.index.still_seconds)
{
    candidate_options_.check();
    options.check_between_sections();
    if (options.same_place.enabled)
    {
        model_.emplace(options.same_place);
        believable_log_odds_ = model_->min_log_odds();
    }
    if (!options.consistency.belief) return;
    belief_.emplace(options.consistency);
    believable_log_odds_ = log_odds_of(options.consistency.min_pair_probability);
    if (options.consistency.look_ahead_seconds > 0) smoother_.emplace(options.consistency);
}

std::vector<DetectorOutcome> LoopDetector::process(FrameDescription description, StageTimes& times)
{
    if (last_frame_ && description.frame <= *last_frame_)
        throw std::invalid_argument("LoopDetector: frame ids must increase");
    if (description.defect == Rejection::none && description.global.size() != global_dimension_)
        throw std::invalid_argument("LoopDetector: a global descriptor of " +
                                    std::to_string(description.global.size()) +
                                    " numbers instead of " + std::to_string(global_dimension_));
    last_frame_ = description.frame;
    instant_ = instants_.add(description.sensor_label);
    if (description.defect != Rejection::none)
    {
        waiting_.push({{verdict_of(description, description.defect), {}, {}, {}}, false}, now_);
        return take_due(times);
    }
    const auto stands_since = enqueue(description, times);
    auto outcome = find_loop(description, times);
    check_consistency(description.local, outcome, times);
    outcome.depth_source = description.metric.depths.source;
    outcome.global = description.global;
    remember(std::move(description), stands_since);
    const bool may_change = smoother_ && !believable(outcome).empty();
    waiting_.push({std::move(outcome), true, may_change}, now_);
    return take_due(times);
}

std::vector<DetectorOutcome> LoopDetector::finish(StageTimes& times)
{
    std::vector<DetectorOutcome> outcomes;
    while (!waiting_.empty()) outcomes.push_back(decide(waiting_.pop(), times));
    return outcomes;
}

/** The frame becomes a candidate after the delay, unless its camera stands still: then it shows
 *  nothing new. \return since when it stands. */
std::optional<FrameId> LoopDetector::enqueue(const FrameDescription& description, StageTimes& times)
{
    now_ = clock_.advance(description.sensor_label, description.timestamp);
    const auto stands_since =
        standstill_.add(description.frame, description.sensor_label, description.local, now_);
    if (stands_since) return stands_since;
    const double moving = standstill_.moving_seconds();
    insert_released(
        queue_.push({description.frame, moving, description.global, description.sensor_label}),
        times);
    return std::nullopt;
}

void LoopDetector::insert_released(const std::vector<DelayQueue::Entry>& released,
                                   StageTimes& times)
{
    for (const auto& entry : released)
    {
        const StageTimer timer(times, "index_insertion");
        index_->insert(entry.frame, entry.descriptor);
        const bool is_last_place =
            last_released_ &&
            instants_between(places_.at(entry.frame), places_.at(*last_released_)) == 0;
        if (belief_) belief_->add_place(entry.frame, is_last_place);
        last_released_ = entry.frame;
    }
}

DetectorOutcome LoopDetector::find_loop(const FrameDescription& query, StageTimes& times) const
{
    if (index_->size() == 0) return {verdict_of(query, Rejection::too_early), {}, {}, {}};
    const auto answers = search(query, times);
    if (answers.empty()) return {verdict_of(query, Rejection::no_candidate), {}, {}, {}};

    Trials trials(*this, query, answers, times);
    for (const auto& candidate : promising(query, in_order_of_promise(query, answers, times)))
    {
        trials.verify(candidate);
        if (candidate_options_.stop_at_first && trials.convinces()) break;
    }
    follow_neighbours(query, trials);
    return std::move(trials).outcome();
}

std::vector<Candidate> LoopDetector::search(const FrameDescription& query, StageTimes& times) const
{
    const StageTimer timer(times, "index_search");
    const auto wanted = static_cast<std::size_t>(index_options_.candidates);
    const auto width = static_cast<std::size_t>(index_options_.search_width);
    // No more than ef: hnswlib would search as wide as it is asked for answers.
    return index_->search(query.global, std::max(wanted, std::min(kToldAnswers, width)));
}

/** The nearest neighbours; with best_by_cells those that agree with the query in most cells first. */
std::vector<Candidate> LoopDetector::in_order_of_promise(const FrameDescription& query,
                                                         std::vector<Candidate> answers,
                                                         StageTimes& times) const
{
    answers.resize(std::min(answers.size(), static_cast<std::size_t>(index_options_.candidates)));
    if (candidate_options_.best_by_cells == 0) return answers;
    const StageTimer timer(times, "cells");
    std::vector<std::pair<std::size_t, Candidate>> ranking;
    ranking.reserve(answers.size());
    for (const auto& answer : answers)
        ranking.emplace_back(
            cell_motion(query.local.cells, places_.at(answer.frame).local.cells).agreeing(),
            answer);
    std::stable_sort(ranking.begin(),
                     ranking.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::transform(ranking.begin(),
                   ranking.end(),
                   answers.begin(),
                   [](const auto& each) { return each.second; });
    return answers;
}

/** \param answers  the most promising first. */
std::vector<Candidate> LoopDetector::promising(const FrameDescription& query,
                                               const std::vector<Candidate>& answers) const
{
    const auto most = candidate_options_.best_by_cells == 0
                          ? answers.size()
                          : static_cast<std::size_t>(candidate_options_.best_by_cells);
    std::vector<Candidate> chosen;
    for (const auto& answer : answers)
    {
        const auto shows_the_same_place = [&](const Candidate& other)
        {
            const auto& a = places_.at(other.frame);
            const auto& b = places_.at(answer.frame);
            return a.sensor_label == b.sensor_label &&
                   instants_between(a, b) <=
                       static_cast<std::size_t>(candidate_options_.place_frames);
        };
        if (chosen.size() < most && answer.similarity >= index_options_.min_similarity &&
            std::none_of(chosen.begin(), chosen.end(), shows_the_same_place))
            chosen.push_back(answer);
    }
    if (!candidate_options_.follow_belief) return chosen;
    if (const auto place = belief_->likeliest())
    {
        const auto frame = seen_by(query.sensor_label, *place);
        chosen.push_back({frame, index_->similarity(query.global, frame)});
    }
    return chosen;
}

/** The frame of a camera at the instant of a place's first frame; that frame when there is none. */
FrameId LoopDetector::seen_by(const std::string& camera, FrameId first) const
{
    const auto instant = places_.at(first).instant;
    for (auto id = first; id <= *last_released_; id = FrameId{to_index(id) + 1})
    {
        const auto found = places_.find(id);
        if (found == places_.end() || found->second.stands_since) continue;
        if (found->second.instant != instant) break;
        if (found->second.sensor_label == camera) return id;
    }
    return first;
}

/** Matches and verifies the query with the entry's candidate, of which the outcome then tells. */
void LoopDetector::verify(const HashedFeatures& query,
                          ConsideredCandidate& entry,
                          DetectorOutcome& outcome,
                          StageTimes& times) const
{
    auto& verdict = outcome.verdict;
    verdict.candidate = entry.candidate;
    const auto& place = places_.at(entry.candidate.frame).local;
    auto [matches, verification, evidence, odds] = pairs_.verify(query, place, times);
    outcome.matches.clear();
    for (const auto& match : matches)
        outcome.matches.push_back({query.positions[match.query], place.positions[match.candidate]});
    outcome.keypoint_matches = std::move(matches);
    verdict.matches = outcome.matches.size();
    verdict.inliers = verification.inliers.size();
    verdict.rejection = verification.rejection;
    if (odds && verdict.rejection == Rejection::none && !model_->convinces(*odds))
        verdict.rejection = weakness_of(*odds);
    if (model_)
        verdict.support = odds ? probability_of(odds->log_odds()) : 0;
    else
        verdict.support = static_cast<double>(verdict.inliers) / static_cast<double>(min_inliers_);
    outcome.inliers = std::move(verification.inliers);
    entry = {entry.candidate,
             entry.rank,
             true,
             verdict.matches,
             verdict.inliers,
             verdict.support,
             verdict.rejection,
             evidence,
             odds};
}

void LoopDetector::follow_neighbours(const FrameDescription& query, Trials& trials) const
{
    if (trials.best() == nullptr || trials.best()->inliers < min_inliers_) return;
    for (const bool later : {false, true})
    {
        auto frame = trials.best()->candidate->frame;
        for (int not_better = 0; not_better < candidate_options_.neighbour_reach;)
        {
            const auto next = neighbour_of(frame, later);
            if (!next) break;
            frame = *next;
            const Candidate neighbour{frame, index_->similarity(query.global, frame)};
            const bool better =
                neighbour.similarity >= index_options_.min_similarity && trials.verify(neighbour);
            not_better = better ? 0 : not_better + 1;
        }
    }
}

std::optional<FrameId> LoopDetector::neighbour_of(FrameId place, bool later) const
{
    const auto& label = places_.at(place).sensor_label;
    auto id = to_index(place);
    while (later ? FrameId{id} < *last_released_ : id > 0)
    {
        id = later ? id + 1 : id - 1;
        const auto found = places_.find(FrameId{id});
        const bool is_in_index = found != places_.end() && !found->second.stands_since;
        if (is_in_index && found->second.sensor_label == label) return FrameId{id};
    }
    return std::nullopt;
}

void LoopDetector::check_consistency(const HashedFeatures& query,
                                     DetectorOutcome& outcome,
                                     StageTimes& times)
{
    auto& verdict = outcome.verdict;
    if (belief_)
    {
        update_belief(outcome);
        ask(belief_->states(), query, outcome, times);
    }
    else if (!verdict.accepted())
        consistency_.add_unverified(verdict.sensor_label);
    else if (!consistency_.add_verified(verdict.sensor_label,
                                        places_.at(verdict.candidate->frame).timestamp))
        verdict.rejection = Rejection::not_consistent_yet;
}

void LoopDetector::update_belief(const DetectorOutcome& outcome)
{
    std::vector<ComparedPlace> compared;
    for (const auto& entry : outcome.considered)
        if (entry.checked) compared.push_back({entry.candidate.frame, entry.odds});
    belief_->update(compared, instant_ != believed_instant_);
    believed_instant_ = instant_;
    if (smoother_) smoother_->add(*belief_);
}

/** Names the candidate that the belief holds for the most probable, and judges it. */
void LoopDetector::ask(const PlaceStates& states,
                       const HashedFeatures& query,
                       DetectorOutcome& outcome,
                       StageTimes& times) const
{
    const auto candidates = believable(outcome);
    if (candidates.empty()) return;
    auto named = most_probable(candidates, states);
    if (named.candidate.frame != outcome.verdict.candidate->frame)
        verify(query, named, outcome, times);
    judge(outcome.verdict, named.rejection, probability_near(candidates, states));
}

std::vector<BelievableCandidate> LoopDetector::believable(const DetectorOutcome& outcome) const
{
    std::vector<BelievableCandidate> candidates;
    for (const auto& entry : outcome.considered)
        if (entry.odds && entry.odds->log_odds() >= believable_log_odds_)
            candidates.push_back({&entry, belief_->place_of(entry.candidate.frame)});
    return candidates;
}

/** \param of_pair  why the pair alone would be rejected. \param probability  that the frame shows
 *  the candidate's place. */
void LoopDetector::judge(FrameVerdict& verdict, Rejection of_pair, double probability) const
{
    verdict.support = probability;
    if (log_odds_of(probability) >= model_->min_log_odds())
        verdict.rejection = Rejection::none;
    else if (of_pair == Rejection::none)
        verdict.rejection = Rejection::not_consistent_yet;
    else
        verdict.rejection = of_pair;
}

std::vector<DetectorOutcome> LoopDetector::take_due(StageTimes& times)
{
    std::vector<DetectorOutcome> outcomes;
    while (waiting_.oldest_is_due()) outcomes.push_back(decide(waiting_.pop(), times));
    return outcomes;
}

DetectorOutcome LoopDetector::decide(WaitingVerdict waiting, StageTimes& times)
{
    auto& outcome = waiting.outcome;
    if (waiting.may_change) ask_later_frames(outcome, times);
    if (smoother_ && waiting.is_usable) smoother_->drop_oldest();
    add_pose(outcome, times);
    return std::move(outcome);
}

void LoopDetector::ask_later_frames(DetectorOutcome& outcome, StageTimes& times) const
{
    PlaceStates states;
    {
        const StageTimer timer(times, "look_ahead");
        states = smoother_->oldest();
    }
    ask(states, places_.at(outcome.verdict.frame).local, outcome, times);
}

void LoopDetector::add_pose(DetectorOutcome& outcome, StageTimes& times) const
{
    if (!estimates_poses_ || !outcome.verdict.accepted()) return;
    const StageTimer timer(times, "relative_pose");
    const auto& query = places_.at(outcome.verdict.frame);
    const auto& place = places_.at(outcome.verdict.candidate->frame);
    std::vector<Match> verified;
    verified.reserve(outcome.inliers.size());
    for (const auto k : outcome.inliers) verified.push_back(outcome.keypoint_matches[k]);
    const auto view_of = [](const Place& frame) -> PoseView {
        return {frame.metric.camera, frame.local.positions, frame.metric.depths};
    };
    outcome.pose = poses_.estimate(view_of(query), view_of(place), verified);
}

const Place* LoopDetector::find_place(FrameId frame) const
{
    const auto found = places_.find(frame);
    return found == places_.end() ? nullptr : &found->second;
}

std::size_t LoopDetector::map_bytes() const
{
    return feature_bytes_ + queue_.size() * global_dimension_ * sizeof(float) +
           index_->descriptor_bytes();
}

void LoopDetector::remember(FrameDescription description, std::optional<FrameId> stands_since)
{
    feature_bytes_ += bytes_of(description.local) + bytes_of(description.metric.depths);
    places_.emplace(description.frame,
                    Place{description.timestamp,
                          std::move(description.sensor_label),
                          std::move(description.local),
                          std::move(description.metric),
                          instant_,
                          stands_since});
}

}  // namespace fild
