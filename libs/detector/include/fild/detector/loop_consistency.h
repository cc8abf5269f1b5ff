// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/detector/candidate_choice.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/detector_outcome.h"
#include "fild/detector/place_belief.h"
#include "fild/detector/place_smoother.h"
#include "fild/detector/temporal_consistency.h"
#include "fild/places/place_map.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** The candidate that the frames before and after a query speak for. */
struct BelievedCandidate
{
    ConsideredCandidate entry;
    double probability = 0;  ///< that the query shows its place
};

/** Holds a frame's candidates against the frames before it and, with look-ahead, after it: by a
 *  belief over the places of the map, or by the paper's row of beta verified frames (FILD, section
 *  III-C). Deterministic. Not thread-safe: one caller at a time. */
class LoopConsistency
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit LoopConsistency(const TDetectorOptions& options);

    /** The frame is a place of the map from now on: with frames of other cameras at one instant it
     *  is one place of the belief. */
    void add_place(FrameId frame, std::size_t instant);

    /** The first frame of the place where the camera is believed to be; none without a belief, or
     *  when it is weak. */
    std::optional<FrameId> expected_place() const;

    /** Takes the next frame, each pair of which was judged alone. Without a belief its verdict is
     *  the last one: a verified frame that closes no row becomes not_consistent_yet.
     *  \param instant  of the frame. */
    void take(DetectorOutcome& outcome, std::size_t instant, const PlaceMap& places);

    /** What this frame, the last taken, and those before it say; none without a belief or without a
     *  candidate that could be believed. */
    std::optional<BelievedCandidate> believed(const DetectorOutcome& outcome) const;

    /** True when frames to come may change what is believed. */
    bool waits(const DetectorOutcome& outcome) const;

    /** What all frames taken say of the oldest that was taken and not dropped. */
    std::optional<BelievedCandidate> believed_of_oldest(const DetectorOutcome& outcome) const;
    void drop_oldest();

    /** The verdict on a frame that is held to show that candidate's place. */
    void judge(const BelievedCandidate& believed, FrameVerdict& verdict) const;

 private:
    std::vector<BelievableCandidate> believable(const DetectorOutcome& outcome) const;
    std::optional<BelievedCandidate> most_believed(const DetectorOutcome& outcome,
                                                   const PlaceStates& states) const;

    TemporalConsistency rows_;
    std::optional<PlaceBelief> belief_;  ///< none: consecutive frames are counted
    std::optional<PlaceSmoother> smoother_;  ///< of the waiting frames; none: no look-ahead
    double believable_log_odds_;  ///< of a pair that may be accepted
    double min_log_odds_;  ///< of a loop closure
    std::size_t last_place_instant_ = 0;  ///< of the last place; 0: there is none
    std::size_t last_instant_ = 0;  ///< of the last frame taken
};

}  // namespace fild
