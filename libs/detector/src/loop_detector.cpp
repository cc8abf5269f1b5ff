// SPDX-License-Identifier: BSD-3-Clause
// The FILD pipeline (An et al., IROS 2019), Figure 2.
#include "fild/detector/loop_detector.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
WaitingVerdict unusable(const FrameDescription& description)
{
    return {{verdict_of(description, description.defect), {}, {}, {}}, false};
}
}  // namespace

LoopDetector::LoopDetector(const TDetectorOptions& options,
                           std::size_t global_dimension,
                           PlaceMap& places)
    : global_dimension_(global_dimension),
      places_(places),
      delay_(options.index),
      recognizer_(options, global_dimension, places),
      consistency_(options),
      waiting_(options)
{
    options.check_between_sections();
}

std::vector<DetectorOutcome> LoopDetector::process(FrameDescription description, StageTimes& times)
{
    require_next(description);
    last_frame_ = description.frame;
    const bool is_usable = description.defect == Rejection::none;
    if (!is_usable) delay_.skip(description);
    auto verdict = is_usable ? look_at(std::move(description), times) : unusable(description);
    waiting_.push(std::move(verdict), delay_.now());
    std::vector<DetectorOutcome> outcomes;
    while (waiting_.oldest_is_due()) outcomes.push_back(decide(waiting_.pop(), times));
    return outcomes;
}

std::vector<DetectorOutcome> LoopDetector::finish(StageTimes& times)
{
    std::vector<DetectorOutcome> outcomes;
    while (!waiting_.empty()) outcomes.push_back(decide(waiting_.pop(), times));
    return outcomes;
}

std::size_t LoopDetector::descriptor_bytes() const
{
    return recognizer_.bytes() + delay_.waiting() * global_dimension_ * sizeof(float);
}

void LoopDetector::require_next(const FrameDescription& description) const
{
    if (last_frame_ && description.frame <= *last_frame_)
        throw std::invalid_argument("LoopDetector: frame ids must increase");
    if (description.defect == Rejection::none && description.global.size() != global_dimension_)
        throw std::invalid_argument("LoopDetector: a global descriptor of " +
                                    std::to_string(description.global.size()) +
                                    " numbers instead of " + std::to_string(global_dimension_));
}

/** The steps of Figure 2, for a frame that can be used. */
WaitingVerdict LoopDetector::look_at(FrameDescription description, StageTimes& times)
{
    const auto arrival = delay_.take(description);
    insert_released(arrival.released, times);
    auto outcome = recognizer_.recognize(description, consistency_.expected_place(), times);
    consistency_.take(outcome, arrival.instant, places_);
    confirm(consistency_.believed(outcome), description.local, outcome, times);
    outcome.depth_source = description.metric.depths.source;
    outcome.global = std::move(description.global);
    places_.append(description.frame,
                   {description.timestamp,
                    std::move(description.sensor_label),
                    std::move(description.local),
                    std::move(description.metric),
                    arrival.instant,
                    arrival.stands_since});
    const bool may_change = consistency_.waits(outcome);
    return {std::move(outcome), true, may_change};
}

void LoopDetector::insert_released(const std::vector<DelayQueue::Entry>& released,
                                   StageTimes& times)
{
    for (const auto& entry : released)
    {
        const StageTimer timer(times, "index_insertion");
        recognizer_.insert(entry.frame, entry.descriptor);
        consistency_.add_place(entry.frame, places_.at(entry.frame).instant);
    }
}

/** Names the candidate that is believed in, and judges it. */
void LoopDetector::confirm(const std::optional<BelievedCandidate>& believed,
                           const HashedFeatures& query,
                           DetectorOutcome& outcome,
                           StageTimes& times) const
{
    if (!believed) return;
    auto named = believed->entry;
    if (named.candidate.frame != outcome.verdict.candidate->frame)
        recognizer_.compare(query, named, outcome, times);
    consistency_.judge(*believed, outcome.verdict);
}

DetectorOutcome LoopDetector::decide(WaitingVerdict waiting, StageTimes& times)
{
    auto& outcome = waiting.outcome;
    if (waiting.may_change)
    {
        std::optional<BelievedCandidate> believed;
        {
            const StageTimer timer(times, "look_ahead");
            believed = consistency_.believed_of_oldest(outcome);
        }
        confirm(believed, places_.at(outcome.verdict.frame).local, outcome, times);
    }
    if (waiting.is_usable) consistency_.drop_oldest();
    return std::move(outcome);
}

}  // namespace fild
