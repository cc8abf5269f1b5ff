// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/core/verdict.h"
#include "fild/detector/candidate_choice.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/detector_outcome.h"
#include "fild/detector/frame_describer.h"
#include "fild/detector/pair_verifier.h"
#include "fild/detector/place.h"
#include "fild/detector/place_belief.h"
#include "fild/detector/place_smoother.h"
#include "fild/detector/recording_clock.h"
#include "fild/detector/standstill.h"
#include "fild/detector/temporal_consistency.h"
#include "fild/detector/waiting_verdicts.h"
#include "fild/geometry/relative_pose.h"
#include "fild/index/delay_queue.h"
#include "fild/index/instant_counter.h"
#include "fild/index/place_index.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
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
    /** \param global_dimension  length of the global descriptors that will come. */
    LoopDetector(const TDetectorOptions& options, std::size_t global_dimension);

    /** Takes the next frame.
     *  \param times receives "index_insertion", "index_search", "cells", "matching",
     *  "verification", "evidence", "look_ahead" and "relative_pose".
     *  \return the frames whose verdict can now be given, oldest first. Without look-ahead this frame,
     *  and no other.
     *  \throw std::invalid_argument when ids do not increase or a descriptor has another length;
     *  nothing has changed then. */
    std::vector<DetectorOutcome> process(FrameDescription description, StageTimes& times);

    /** Gives the verdicts that still wait for later frames, at the end of the recording: none without
     *  look-ahead. */
    std::vector<DetectorOutcome> finish(StageTimes& times);

    /** What is kept of a frame; null for one that was not processed, or could not be used. Valid
     *  until the next call of process(). */
    const Place* find_place(FrameId frame) const;

    /** Memory of codes, positions, depths and descriptors held for later frames, bytes; the links
     * of the HNSW graph (about 8 x links_per_node bytes a frame) not counted. */
    std::size_t map_bytes() const;

    /** How often a camera's time stamps jumped: RecordingClock::jumps(). */
    std::size_t clock_jumps() const { return clock_.jumps(); }

 private:
    class Trials;

    void insert_released(const std::vector<DelayQueue::Entry>& released, StageTimes& times);
    std::vector<Candidate> search(const FrameDescription& query, StageTimes& times) const;
    DetectorOutcome find_loop(const FrameDescription& query, StageTimes& times) const;
    std::vector<Candidate> in_order_of_promise(const FrameDescription& query,
                                               std::vector<Candidate> answers,
                                               StageTimes& times) const;
    std::vector<Candidate> promising(const FrameDescription& query,
                                     const std::vector<Candidate>& answers) const;
    void verify(const HashedFeatures& query,
                ConsideredCandidate& entry,
                DetectorOutcome& outcome,
                StageTimes& times) const;
    void follow_neighbours(const FrameDescription& query, Trials& trials) const;
    std::optional<FrameId> neighbour_of(FrameId place, bool later) const;
    FrameId seen_by(const std::string& camera, FrameId first) const;
    void check_consistency(const HashedFeatures& query,
                           DetectorOutcome& outcome,
                           StageTimes& times);
    void update_belief(const DetectorOutcome& outcome);
    void ask(const PlaceStates& states,
             const HashedFeatures& query,
             DetectorOutcome& outcome,
             StageTimes& times) const;
    void judge(FrameVerdict& verdict, Rejection of_pair, double probability) const;
    std::vector<BelievableCandidate> believable(const DetectorOutcome& outcome) const;
    std::vector<DetectorOutcome> take_due(StageTimes& times);
    DetectorOutcome decide(WaitingVerdict waiting, StageTimes& times);
    void ask_later_frames(DetectorOutcome& outcome, StageTimes& times) const;
    void add_pose(DetectorOutcome& outcome, StageTimes& times) const;
    std::optional<FrameId> enqueue(const FrameDescription& description, StageTimes& times);
    void remember(FrameDescription description, std::optional<FrameId> stands_since);

    std::size_t global_dimension_;
    TIndexOptions index_options_;
    TCandidateOptions candidate_options_;
    bool estimates_poses_;
    std::size_t min_inliers_;
    DelayQueue queue_;
    std::unique_ptr<PlaceIndex> index_;
    PairVerifier pairs_;
    RelativePoseEstimator poses_;
    TemporalConsistency consistency_;
    std::optional<SamePlaceModel> model_;  ///< none: [same_place] is off
    std::optional<PlaceBelief> belief_;  ///< none: consecutive frames are counted
    double believable_log_odds_ = 0;  ///< of a pair that may be accepted
    std::optional<PlaceSmoother> smoother_;  ///< of the waiting frames; none: no look-ahead
    WaitingVerdicts waiting_;

    std::unordered_map<FrameId, Place> places_;
    std::size_t feature_bytes_ = 0;  ///< of `places_`
    RecordingClock clock_;
    double now_ = 0;  ///< of the last usable frame, by the clock
    InstantCounter instants_;
    std::size_t instant_ = 0;  ///< of the last frame
    std::size_t believed_instant_ = 0;  ///< of the last frame that the belief was updated with
    Standstill standstill_;
    std::optional<FrameId> last_frame_;
    std::optional<FrameId> last_released_;  ///< by the delay queue
};

}  // namespace fild
