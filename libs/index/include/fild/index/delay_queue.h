// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"
#include "fild/index/index_options.h"
#include "fild/index/instant_counter.h"

#include <deque>
#include <string>
#include <vector>

namespace fild
{
/** The first-in-first-out queue that keeps recent frames out of the index, FILD (IROS 2019)
 *  section III-B.3, so that a frame is never compared with its own neighbourhood.
 *
 *  Deviation: the paper counts psi x phi frames; measured by time (frame_rate 0) the delay holds
 * for recordings with pauses and dropped frames too. Not thread-safe: one caller at a time. */
class DelayQueue
{
 public:
    struct Entry
    {
        FrameId frame{};
        double time = 0;  ///< seconds, never smaller than that of the entry before
        GlobalDescriptor descriptor;
        std::string camera;  ///< its sensor label
    };

    /** Uses delay_seconds and frame_rate. */
    explicit DelayQueue(const TIndexOptions& options);

    /** Adds the current frame, then gives back, oldest first, the entries that have waited: those
     * at least psi seconds (or psi x phi frames of a camera) older than it. \throw std::invalid_argument when
     * entry.time is smaller than the last one's. */
    std::vector<Entry> push(Entry entry);

    std::size_t size() const { return entries_.size(); }

 private:
    struct Waiting
    {
        Entry entry;
        std::size_t instant = 0;
    };

    bool has_waited(const Waiting& oldest) const;

    double delay_seconds_;
    double delay_frames_;  ///< 0: by time
    InstantCounter instants_;
    std::deque<Waiting> entries_;
};

}  // namespace fild
