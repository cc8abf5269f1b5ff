// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/detector/detector_options.h"
#include "fild/detector/place_belief.h"
#include "fild/detector/place_states.h"

#include <cstddef>
#include <deque>

namespace fild
{
/** Lets later frames say where the camera was: the backward pass over the model of PlaceBelief, for
 *  the frames of a window that the caller moves (fixed-lag smoothing). A doubtful frame before a
 *  clear return gains, and a convincing one that the frames after it contradict loses.
 *
 *  Memory: four numbers a place for each frame of the window. Deterministic. Not thread-safe: one
 *  caller at a time. */
class PlaceSmoother
{
 public:
    /** \param options  of the belief. \throw std::invalid_argument on bad options. */
    explicit PlaceSmoother(const TConsistencyOptions& options);

    /** The window gets the frame that the belief was just updated with. */
    void add(const PlaceBelief& belief);

    /** The probability of each state at the oldest frame of the window, given the frames before it
     *  and all in the window; for one frame alone, that of the belief. Costs a few nanoseconds for
     *  each place and frame of the window. \pre the window has a frame. */
    PlaceStates oldest() const;

    /** The oldest frame leaves the window. \pre there is one. */
    void drop_oldest() { window_.pop_front(); }

    std::size_t size() const { return window_.size(); }

 private:
    struct SeenFrame
    {
        PlaceStates belief;  ///< of the forward pass
        PlaceEvidence evidence;
    };

    PlaceStates move_back(const PlaceStates& later, const PlaceEvidence& evidence) const;

    TConsistencyOptions options_;
    std::deque<SeenFrame> window_;
};

}  // namespace fild
