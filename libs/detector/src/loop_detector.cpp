// SPDX-License-Identifier: BSD-3-Clause
// The FILD pipeline (An et al., IROS 2019), Figure 2.
#include "fild/detector/loop_detector.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace fild
{
namespace
{
/** Which candidate a verdict speaks of: verified ones first, then by inliers, then by matches.
 * Equals stay in the order of the search, most similar first. */
bool came_further(const DetectorOutcome& a, const DetectorOutcome& b)
{
    const auto rank = [](const DetectorOutcome& outcome)
    {
        const auto& verdict = outcome.verdict;
        return std::make_tuple(verdict.accepted(), verdict.inliers, verdict.matches);
    };
    return rank(a) > rank(b);
}

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

std::size_t bytes_of(const HashedFeatures& features)
{
    return features.positions.size() * sizeof(PixelPosition) +
           features.codes.words.size() * sizeof(std::uint64_t) +
           features.codes.buckets.size() * sizeof(std::uint16_t);
}
}  // namespace

LoopDetector::LoopDetector(const TDetectorOptions& options, std::size_t global_dimension)
    : min_similarity_(options.index.min_similarity),
      candidates_(static_cast<std::size_t>(options.index.candidates)),
      follow_neighbours_(options.index.follow_neighbours),
      queue_(options.index),
      index_(make_place_index(
          options.index, global_dimension, static_cast<std::uint64_t>(options.runtime.seed))),
      matcher_(options.hashing),
      verifier_(options.verification, static_cast<std::uint64_t>(options.runtime.seed)),
      consistency_(options.consistency)
{
}

DetectorOutcome LoopDetector::process(FrameDescription description, StageTimes& times)
{
    if (last_frame_ && description.frame <= *last_frame_)
        throw std::invalid_argument("LoopDetector: frame ids must increase");
    last_frame_ = description.frame;
    if (description.defect != Rejection::none)
        return {verdict_of(description, description.defect), {}, {}};

    const double now = advance_clock(description.timestamp);
    insert_released(queue_.push({description.frame, now, description.global}), times);
    auto outcome = find_loop(description, times);
    check_consistency(outcome);
    remember(std::move(description));
    return outcome;
}

double LoopDetector::advance_clock(double timestamp)
{
    const double step = last_timestamp_ ? timestamp - *last_timestamp_ : 0;
    if (step < 0) ++clock_jumps_;
    last_timestamp_ = timestamp;
    clock_ += std::max(step, 0.0);
    return clock_;
}

void LoopDetector::insert_released(const std::vector<DelayQueue::Entry>& released,
                                   StageTimes& times)
{
    for (const auto& entry : released)
    {
        const StageTimer timer(times, "index_insertion");
        index_->insert(entry.frame, entry.descriptor);
        last_released_ = entry.frame;
    }
}

DetectorOutcome LoopDetector::find_loop(const FrameDescription& query, StageTimes& times)
{
    if (index_->size() == 0) return {verdict_of(query, Rejection::too_early), {}, {}};
    std::vector<Candidate> candidates;
    {
        const StageTimer timer(times, "index_search");
        candidates = index_->search(query.global, candidates_);
    }
    if (candidates.empty()) return {verdict_of(query, Rejection::no_candidate), {}, {}};

    std::optional<DetectorOutcome> furthest;
    for (const auto& candidate : candidates)
    {
        if (candidate.similarity < min_similarity_) break;  // most similar first
        auto outcome = verify(query, candidate, times);
        if (!furthest || came_further(outcome, *furthest)) furthest = std::move(outcome);
    }
    if (furthest)
        return follow_neighbours_ ? best_of_neighbours(query, std::move(*furthest), times)
                                  : std::move(*furthest);
    DetectorOutcome unlike{verdict_of(query, Rejection::below_similarity), {}, {}};
    unlike.verdict.candidate = candidates.front();
    return unlike;
}

DetectorOutcome LoopDetector::verify(const FrameDescription& query,
                                     const Candidate& candidate,
                                     StageTimes& times) const
{
    DetectorOutcome outcome{verdict_of(query, Rejection::none), {}, {}};
    auto& verdict = outcome.verdict;
    verdict.candidate = candidate;
    const auto& place = places_.at(candidate.frame).local;
    {
        const StageTimer timer(times, "matching");
        for (const auto& match : matcher_.match(query.local.codes, place.codes))
            outcome.matches.push_back(
                {query.local.positions[match.query], place.positions[match.candidate]});
    }
    const StageTimer timer(times, "verification");
    std::vector<PixelPosition> in_query;
    std::vector<PixelPosition> in_candidate;
    for (const auto& pair : outcome.matches)
    {
        in_query.push_back(pair.query);
        in_candidate.push_back(pair.candidate);
    }
    auto verification = verifier_.verify(in_query, in_candidate);
    verdict.matches = outcome.matches.size();
    verdict.inliers = verification.inliers.size();
    verdict.rejection = verification.rejection;
    outcome.inliers = std::move(verification.inliers);
    return outcome;
}

DetectorOutcome LoopDetector::best_of_neighbours(const FrameDescription& query,
                                                 DetectorOutcome best,
                                                 StageTimes& times) const
{
    for (const bool later : {false, true})
    {
        const auto start = best.verdict.candidate->frame;
        while (best.verdict.inliers > 0)
        {
            const auto neighbour = neighbour_of(best.verdict.candidate->frame, later, query);
            if (!neighbour || neighbour->similarity < min_similarity_) break;
            auto outcome = verify(query, *neighbour, times);
            if (!came_further(outcome, best)) break;
            best = std::move(outcome);
        }
        if (best.verdict.candidate->frame != start) break;  // the other way leads back
    }
    return best;
}

std::optional<Candidate> LoopDetector::neighbour_of(FrameId place,
                                                    bool later,
                                                    const FrameDescription& query) const
{
    const auto& label = places_.at(place).sensor_label;
    auto id = to_index(place);
    while (later ? FrameId{id} < *last_released_ : id > 0)
    {
        id = later ? id + 1 : id - 1;
        const auto found = places_.find(FrameId{id});
        if (found == places_.end() || found->second.sensor_label != label) continue;
        const auto& global = found->second.global;
        const auto cosine =
            std::inner_product(global.begin(), global.end(), query.global.begin(), 0.0F);
        return Candidate{FrameId{id}, cosine};
    }
    return std::nullopt;
}

void LoopDetector::check_consistency(DetectorOutcome& outcome)
{
    auto& verdict = outcome.verdict;
    if (!verdict.accepted())
    {
        consistency_.add_unverified();
        return;
    }
    const auto& place = places_.at(verdict.candidate->frame);
    if (!consistency_.add_verified(place.timestamp, verdict.inliers, verdict.keypoints))
        verdict.rejection = Rejection::not_consistent_yet;
}

void LoopDetector::remember(FrameDescription description)
{
    map_bytes_ += bytes_of(description.local) + description.global.size() * sizeof(float);
    places_.emplace(description.frame,
                    Place{description.timestamp,
                          std::move(description.sensor_label),
                          std::move(description.global),
                          std::move(description.local)});
}

}  // namespace fild
