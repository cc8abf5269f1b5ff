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
/** A place that was compared with the current frame; no odds: it had too few inliers for any. */
struct ComparedPlace
{
    FrameId frame{};
    std::optional<PairOdds> odds;
};

/** Where the camera is, as far as its frames up to now tell: a hidden Markov model. The camera is
 * on new ground, at one of the map's places, or at a place that only looks like one of them. From
 *  frame to frame it moves along the earlier path in either direction, jumps, leaves or returns.
 *  A single frame of doubt is believed inside a certain return, and a row of look-alikes is not
 *  believed because one of its frames convinces.
 *
 *  Cost of a frame: linear in the number of places, a few nanoseconds each. Deterministic. Not
 *  thread-safe: one caller at a time. */
class PlaceBelief
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit PlaceBelief(const TConsistencyOptions& options);

    /** A frame becomes a place of the map, after those before it. */
    void add_place(FrameId frame);

    /** Takes in the next frame.
     *  \param compared  places of the map; others are taken to be somewhat unlikely.
     *  \return the probability that the frame shows a place of the map. */
    double update(const std::vector<ComparedPlace>& compared);

    /** The likeliest place, when the camera is more likely at one of the map than elsewhere. */
    std::optional<FrameId> likeliest() const;

 private:
    struct Places
    {
        std::vector<double> same;  ///< probability to be at each place
        std::vector<double> look_alike;  ///< and at one that only looks like it
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
