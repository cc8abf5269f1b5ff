// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/core/verdict.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/detector_outcome.h"
#include "fild/detector/frame_describer.h"
#include "fild/detector/loop_consistency.h"
#include "fild/detector/place_delay.h"
#include "fild/detector/place_recognizer.h"
#include "fild/detector/waiting_verdicts.h"
#include "fild/places/place_map.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** The FILD pipeline, An et al., IROS 2019, Figure 2: finds for each frame the earlier frame that
 *  shows the same place, or says why there is none.
 *
 *  Takes frames in increasing id. Time stamps may be wrong or missing (0), and the clock may be set
 *  on the way: the delay goes on as RecordingClock says. A frame of a camera that stands still is
 *  no candidate later, and the delay waits until it moves: TIndexOptions::still_seconds.
 *  Every frame gets one verdict, in order: at once, or with TConsistencyOptions::look_ahead_seconds
 *  when later frames have been seen.
 *  Deterministic: the same descriptions and
 *  options give the same verdicts. Not thread-safe: one caller at a time. */
class LoopDetector
{
 public:
    /** \param global_dimension  length of the global descriptors that will come.
     *  \param places  empty; gets what is kept of every frame that can be used, and outlives the
     *         detector. */
    LoopDetector(const TDetectorOptions& options, std::size_t global_dimension, PlaceMap& places);

    /** Takes the next frame.
     *  \param times receives "index_insertion", "index_search", "cells", "matching",
     *  "verification", "evidence" and "look_ahead".
     *  \return the frames whose verdict can now be given, oldest first. Without look-ahead this
     *  frame, and no other.
     *  \throw std::invalid_argument when ids do not increase or a descriptor has another length;
     *  nothing has changed then. */
    std::vector<DetectorOutcome> process(FrameDescription description, StageTimes& times);

    /** Gives the verdicts that still wait for later frames, at the end of the recording: none
     *  without look-ahead. */
    std::vector<DetectorOutcome> finish(StageTimes& times);

    /** Memory of the descriptors held for later frames; the links of the HNSW graph (about
     *  8 x links_per_node bytes a frame) not counted. */
    std::size_t descriptor_bytes() const;

    /** How often a camera's time stamps jumped: RecordingClock::jumps(). */
    std::size_t clock_jumps() const { return delay_.clock().jumps(); }

 private:
    void require_next(const FrameDescription& description) const;
    WaitingVerdict look_at(FrameDescription description, StageTimes& times);
    void insert_released(const std::vector<DelayQueue::Entry>& released, StageTimes& times);
    void confirm(const std::optional<BelievedCandidate>& believed,
                 const HashedFeatures& query,
                 DetectorOutcome& outcome,
                 StageTimes& times) const;
    DetectorOutcome decide(WaitingVerdict waiting, StageTimes& times);

    std::size_t global_dimension_;
    PlaceMap& places_;
    PlaceDelay delay_;
    PlaceRecognizer recognizer_;
    LoopConsistency consistency_;
    WaitingVerdicts waiting_;
    std::optional<FrameId> last_frame_;
};

}  // namespace fild
