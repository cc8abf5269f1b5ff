// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/detector/frame_describer.h"
#include "fild/detector/recording_clock.h"
#include "fild/detector/standstill.h"
#include "fild/index/delay_queue.h"
#include "fild/index/instant_counter.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** Decides when a frame becomes a place that later frames can return to: after the delay of FILD
 *  (IROS 2019) section III-B.3, by the clock of the recording, and never when its camera stands
 *  still then: such a frame shows nothing new, and the delay waits until the camera moves.
 *  Deterministic. Not thread-safe: one caller at a time. */
class PlaceDelay
{
 public:
    /** What a new frame brings about. */
    struct Arrival
    {
        std::size_t instant = 0;  ///< as Place::instant, of the new frame
        std::optional<FrameId> stands_since;  ///< as Place::stands_since
        std::vector<DelayQueue::Entry> released;  ///< are places from now on, oldest first
    };

    explicit PlaceDelay(const TIndexOptions& options);

    Arrival take(const FrameDescription& frame);

    /** Passes over a frame that cannot be used. */
    void skip(const FrameDescription& frame) { instants_.add(frame.sensor_label); }

    /** When the last frame was recorded, by the clock of the recording, seconds. */
    double now() const { return now_; }

    const RecordingClock& clock() const { return clock_; }

    std::size_t waiting() const { return queue_.size(); }

 private:
    RecordingClock clock_;
    Standstill standstill_;
    DelayQueue queue_;
    InstantCounter instants_;
    double now_ = 0;
};

}  // namespace fild
