// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/detector/detector_options.h"
#include "fild/detector/detector_outcome.h"
#include "fild/index/instant_counter.h"

#include <cstddef>
#include <deque>

namespace fild
{
/** A frame whose verdict is not given yet. */
struct WaitingVerdict
{
    DetectorOutcome outcome;  ///< as of the frame itself
    bool is_usable = true;  ///< the belief was updated with it
    bool may_change = false;  ///< later frames count
};

/** Holds verdicts back until the frames up to look_ahead_seconds later have been seen, and keeps
 *  their order: one that cannot change waits only for those before it.
 *
 *  With [index] frame_rate, frames are counted instead, as the delay does. At most 200 frames of a
 *  camera are waited for per second, so that a clock that stands still holds nothing back for ever.
 *  Deterministic. Not thread-safe: one caller at a time. */
class WaitingVerdicts
{
 public:
    explicit WaitingVerdicts(const TDetectorOptions& options);

    /** \param now  when the frame was recorded, seconds, never less than for the one before. */
    void push(WaitingVerdict verdict, double now);

    bool empty() const { return frames_.empty(); }

    /** True when there is an oldest frame, and its verdict can be given. */
    bool oldest_is_due() const;

    /** Takes the oldest frame out. \pre there is one. */
    WaitingVerdict pop();

 private:
    struct Frame
    {
        WaitingVerdict verdict;
        double time = 0;
        std::size_t instant = 0;
    };

    double seconds_;
    std::size_t max_instants_;  ///< that one waits for
    bool counts_frames_;
    InstantCounter instants_;
    std::deque<Frame> frames_;
};

}  // namespace fild
