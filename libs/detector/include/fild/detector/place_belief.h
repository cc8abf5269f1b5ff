// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/pair_evidence.h"
#include "fild/core/verdict.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/place_states.h"

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace fild
{
/** Places on either side of a compared one to which its evidence applies, too. */
constexpr int kEvidenceReach = 3;

/** A place that was compared with the current frame. Without odds: it had too few inliers. */
struct ComparedPlace
{
    FrameId frame{};
    std::optional<PairOdds> odds;
};

/** Tracks where the camera is, with a hidden Markov model over the frames so far. The camera is on
 *  new ground, at one of the map's places, or at a place that only looks like one of them. From
 *  frame to frame it moves along the earlier path in either direction, jumps, leaves or returns. So
 *  a doubtful frame within a clear return is accepted, and one convincing frame in a row of
 *  look-alikes is not. This is the forward pass: a frame is judged by itself and the frames before.
 *  PlaceSmoother is the backward pass.
 *
 *  Cost of a frame: linear in the number of places, a few nanoseconds each. Deterministic. Not
 *  thread-safe: one caller at a time. */
class PlaceBelief
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit PlaceBelief(const TConsistencyOptions& options);

    /** Adds a frame as the next place along the path, or to the last place: frames of several
     *  cameras at one instant are one place. */
    void add_place(FrameId frame, bool is_last_place = false);

    /** Updates the belief with the next frame.
     *  \param compared  places of the map that it was compared with; all others count as slightly
     *         unlikely.
     *  \param has_moved  false for a further camera's frame of the same instant.
     *  \return the probability that the frame shows a place of the map. */
    double update(const std::vector<ComparedPlace>& compared, bool has_moved = true);

    /** The most probable place; none when the camera is at a known place with a probability below
     *  0.2. */
    std::optional<FrameId> likeliest() const;

    /** The place of a frame that was added. */
    std::size_t place_of(FrameId frame) const { return places_of_frames_.at(frame); }

    /** The probability of each state after the last update. */
    const PlaceStates& states() const { return at_; }

    /** What the frame of the last update told. */
    const PlaceEvidence& evidence() const { return evidence_; }

 private:
    PlaceEvidence evidence_of(const std::vector<ComparedPlace>& compared) const;
    void move(std::vector<Entrance>& entrances);

    TConsistencyOptions options_;
    std::vector<FrameId> frames_;  ///< the first of each place
    std::unordered_map<FrameId, std::size_t> places_of_frames_;
    PlaceStates at_{1, {}, {}};  ///< probability of each state
    PlaceEvidence evidence_;
};

}  // namespace fild
