// SPDX-License-Identifier: BSD-3-Clause
// Search and verification of FILD (An et al., IROS 2019), sections III-B and III-C.
#include "fild/detector/place_recognizer.h"

#include "fild/detector/candidate_choice.h"
#include "fild/matching/cell_motion.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace fild
{
namespace
{
constexpr std::size_t kToldAnswers = 10;  // that candidates.csv has, verified or not

/** Seen by one camera, at most `frames` of its frames apart. */
bool are_neighbours(const Place& a, const Place& b, int frames)
{
    const auto between = std::max(a.instant, b.instant) - std::min(a.instant, b.instant);
    return a.sensor_label == b.sensor_label && between <= static_cast<std::size_t>(frames);
}
}  // namespace

/** The candidates of one query: what the index answered, which were verified, and the best. Equals
 *  stay in the order of the search, most similar first. */
class PlaceRecognizer::Trials
{
 public:
    Trials(const PlaceRecognizer& recognizer,
           const FrameDescription& query,
           const std::vector<Candidate>& answers,
           StageTimes& times)
        : recognizer_(recognizer), query_(query), times_(times)
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
        recognizer_.compare(query_.local, entry, outcome, times_);
        convinces_ = convinces_ || outcome.verdict.accepted();
        if (best_ && !is_better(entry, best_entry_, recognizer_.enough_log_odds_)) return false;
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

    const PlaceRecognizer& recognizer_;
    const FrameDescription& query_;
    StageTimes& times_;
    std::vector<ConsideredCandidate> considered_;
    std::optional<DetectorOutcome> best_;
    ConsideredCandidate best_entry_;  ///< of `best_`
    bool convinces_ = false;
};

PlaceRecognizer::PlaceRecognizer(const TDetectorOptions& options,
                                 std::size_t global_dimension,
                                 const PlaceMap& places)
    : index_options_(options.index),
      options_(options.candidates),
      enough_log_odds_(believable_log_odds(options)),
      pairs_(options),
      places_(places),
      index_(make_place_index(
          options.index, global_dimension, static_cast<std::uint64_t>(options.runtime.seed)))
{
    options_.check();
}

void PlaceRecognizer::insert(FrameId frame, const GlobalDescriptor& descriptor)
{
    index_->insert(frame, descriptor);
    last_in_index_ = frame;
}

DetectorOutcome PlaceRecognizer::recognize(const FrameDescription& query,
                                           std::optional<FrameId> expected,
                                           StageTimes& times) const
{
    if (!last_in_index_) return {verdict_of(query, Rejection::too_early), {}, {}, {}};
    const auto answers = search(query.global, times);
    if (answers.empty()) return {verdict_of(query, Rejection::no_candidate), {}, {}, {}};

    Trials trials(*this, query, answers, times);
    auto candidates = chosen(in_order_of_promise(query.local.cells, answers, times));
    if (expected && options_.follow_belief)
    {
        const auto seen = places_.seen_by(query.sensor_label, *expected);
        candidates.push_back(candidate_at(seen <= *last_in_index_ ? seen : *expected, query));
    }
    for (const auto& candidate : candidates)
    {
        trials.verify(candidate);
        if (options_.stop_at_first && trials.convinces()) break;
    }
    follow_path(query, trials);
    return std::move(trials).outcome();
}

void PlaceRecognizer::compare(const HashedFeatures& query,
                              ConsideredCandidate& entry,
                              DetectorOutcome& outcome,
                              StageTimes& times) const
{
    const auto& place = places_.at(entry.candidate.frame).local;
    auto pair = pairs_.verify(query, place, times);
    entry = {entry.candidate,
             entry.rank,
             true,
             pair.matches.size(),
             pair.verification.inliers.size(),
             pair.support,
             pair.rejection,
             pair.evidence,
             pair.odds};
    auto& verdict = outcome.verdict;
    verdict.candidate = entry.candidate;
    verdict.matches = entry.matches;
    verdict.inliers = entry.inliers;
    verdict.support = entry.support;
    verdict.rejection = entry.rejection;
    outcome.matches.clear();
    for (const auto& match : pair.matches)
        outcome.matches.push_back({query.positions[match.query], place.positions[match.candidate]});
    outcome.keypoint_matches = std::move(pair.matches);
    outcome.inliers = std::move(pair.verification.inliers);
}

std::vector<Candidate> PlaceRecognizer::search(const GlobalDescriptor& query,
                                               StageTimes& times) const
{
    const StageTimer timer(times, "index_search");
    const auto wanted = static_cast<std::size_t>(index_options_.candidates);
    const auto width = static_cast<std::size_t>(index_options_.search_width);
    // No more than ef: hnswlib would search as wide as it is asked for answers.
    return index_->search(query, std::max(wanted, std::min(kToldAnswers, width)));
}

/** The nearest neighbours; with best_by_cells those that agree with the query in most cells first.
 *  */
std::vector<Candidate> PlaceRecognizer::in_order_of_promise(const CellCodes& query,
                                                            std::vector<Candidate> answers,
                                                            StageTimes& times) const
{
    answers.resize(std::min(answers.size(), static_cast<std::size_t>(index_options_.candidates)));
    if (options_.best_by_cells == 0) return answers;
    const StageTimer timer(times, "cells");
    std::vector<std::pair<std::size_t, Candidate>> ranking;
    ranking.reserve(answers.size());
    for (const auto& answer : answers)
        ranking.emplace_back(cell_motion(query, places_.at(answer.frame).local.cells).agreeing(),
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
std::vector<Candidate> PlaceRecognizer::chosen(const std::vector<Candidate>& answers) const
{
    const auto most = options_.best_by_cells == 0
                          ? answers.size()
                          : static_cast<std::size_t>(options_.best_by_cells);
    std::vector<Candidate> chosen;
    for (const auto& answer : answers)
    {
        const auto shows_the_same_place = [&](const Candidate& other)
        {
            return are_neighbours(
                places_.at(other.frame), places_.at(answer.frame), options_.place_frames);
        };
        if (chosen.size() < most && answer.similarity >= index_options_.min_similarity &&
            std::none_of(chosen.begin(), chosen.end(), shows_the_same_place))
            chosen.push_back(answer);
    }
    return chosen;
}

void PlaceRecognizer::follow_path(const FrameDescription& query, Trials& trials) const
{
    if (trials.best() == nullptr || trials.best()->inliers < pairs_.min_inliers()) return;
    for (const bool later : {false, true})
    {
        auto frame = trials.best()->candidate->frame;
        for (int not_better = 0; not_better < options_.neighbour_reach;)
        {
            const auto next = next_on_path(frame, later);
            if (!next) break;
            frame = *next;
            const auto neighbour = candidate_at(frame, query);
            const bool better =
                neighbour.similarity >= index_options_.min_similarity && trials.verify(neighbour);
            not_better = better ? 0 : not_better + 1;
        }
    }
}

Candidate PlaceRecognizer::candidate_at(FrameId place, const FrameDescription& query) const
{
    return {place, index_->similarity(query.global, place)};
}

std::optional<FrameId> PlaceRecognizer::next_on_path(FrameId place, bool later) const
{
    const auto next = later ? places_.after(place) : places_.before(place);
    return next && *next <= *last_in_index_ ? next : std::nullopt;
}

FrameVerdict verdict_of(const FrameDescription& frame, Rejection rejection)
{
    FrameVerdict verdict;
    verdict.frame = frame.frame;
    verdict.timestamp = frame.timestamp;
    verdict.sensor_label = frame.sensor_label;
    verdict.keypoints = frame.local.positions.size();
    verdict.rejection = rejection;
    return verdict;
}

}  // namespace fild
