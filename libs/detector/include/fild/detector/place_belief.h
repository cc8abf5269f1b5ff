// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/pair_evidence.h"
#include "fild/core/verdict.h"
#include "fild/detector/detector_options.h"

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace fild
{
/** A place that was compared with the current frame. Without odds: it had too few inliers. */
struct ComparedPlace
{
    FrameId frame{};
    std::optional<PairOdds> odds;
};

/** Tracks where the camera is, with a hidden Markov model over the frames so far. The camera is on new
 *  ground, at one of the map's places, or at a place that only looks like one of them. From frame to
 *  frame it moves along the earlier path in either direction, jumps, leaves or returns. So a doubtful
 *  frame within a clear return is accepted, and one convincing frame in a row of look-alikes is not.
 *
 *  Cost of a frame: linear in the number of places, a few nanoseconds each. Deterministic. Not
 *  thread-safe: one caller at a time. */
class PlaceBelief
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit PlaceBelief(const TConsistencyOptions& options);

    /** Adds a frame as the next place along the path. */
    void add_place(FrameId frame);

    /** Updates the belief with the next frame.
     *  \param compared  places of the map that it was compared with; all others count as slightly
     *         unlikely.
     *  \return the probability that the frame shows a place of the map. */
    double update(const std::vector<ComparedPlace>& compared);

    /** The most probable place; none when the camera is at a known place with a probability below
     *  0.2. */
    std::optional<FrameId> likeliest() const;

 private:
    struct Places
    {
        std::vector<double> same;  ///< probability to be at each place
        std::vector<double> look_alike;  ///< probability to be at a look-alike of each place
    };

    void move(const std::vector<std::size_t>& entrances);
    void weigh(const std::vector<ComparedPlace>& compared);
    double sum_of_same() const;

    TConsistencyOptions options_;
    std::vector<FrameId> frames_;
    std::unordered_map<FrameId, std::size_t> places_of_frames_;
    Places at_;
    double new_ground_ = 1;  ///< probability to be there
};

}  // namespace fild
