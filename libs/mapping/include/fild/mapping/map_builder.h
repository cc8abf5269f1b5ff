// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/geodetic.h"
#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/detector_outcome.h"
#include "fild/graph/frame_poses.h"
#include "fild/graph/graph_options.h"
#include "fild/graph/loop_selection.h"
#include "fild/mapping/loop_edge.h"
#include "fild/mapping/motion_agreement.h"
#include "fild/mapping/motion_recorder.h"
#include "fild/mapping/motion_source_use.h"
#include "fild/mapping/pair_poses.h"
#include "fild/places/place_map.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace fild
{
struct MotionEstimate;

/** Where a map's input trajectory comes from. */
enum class TrajectorySource
{
    none,  ///< neither odometry nor GPS, and the images no depth
    recorded,  ///< odometry, actions, robot poses or GPS
    vision,  ///< stereo pairs or depth images, see visual_odometry()
    combined  ///< both
};

/** The enumerator's name. */
const char* to_word(TrajectorySource source);

/** A recording's optimised pose graph and all that led to it. Value type. */
struct Map
{
    Trajectory trajectory;  ///< as it was before the loops
    TrajectorySource trajectory_source = TrajectorySource::none;
    std::vector<MotionSourceUse> sources{};  ///< of motion, that the recording has
    std::vector<std::string> unused_sources{};  ///< odometries beside the one that is used
    /** Of the odometry and the GPS receivers, used or not. */
    std::vector<TrajectoryReport> recorded{};
    std::optional<GeodeticPosition> origin{};  ///< of a map that lies east, north and up of it
    std::string compared_source{};  ///< that `agreement` is about
    double loop_noise_scale = 1;  ///< that the covariances of `loops` were found too small by
    double motion_noise_scale = 1;  ///< likewise of the motion between keyframes
    MotionAgreement agreement{};  ///< of the images with `compared_source`, used or not
    /** Nodes at their optimised poses, loops with a weight of more than 0; see solved_graph(). */
    PoseGraph graph{};
    std::vector<std::vector<FrameId>> parts{};  ///< of the graph, see connected_parts()
    std::vector<TrajectoryPose> optimized{};  ///< of each pose of the trajectory
    std::vector<LoopEdge> loops{};  ///< every accepted loop, in order of the queries
    std::set<FrameId> frames_with_motion_depth{};  ///< of the loops without depth of their own
    /** Sum of the squared errors of all edges and priors of `graph`, times their weights. */
    double chi2_before = 0;  ///< at the poses of the trajectory
    double chi2_after = 0;  ///< at the optimised ones
    bool is_largest_set = true;  ///< see LoopAgreement
    int optimizations = 0;  ///< 0: there was nothing to optimise
};

/** Gathers what a rawlog tells beside its images, and the detector's answers; then builds the map.
 *
 *  The motion is that of all sources of TGraphOptions::sources() that the recording has: odometry
 *  and the motion by stereo pairs or depth images are joined, each with the weight of its
 *  covariance, and GPS receivers say where keyframes are. A single camera gets its scale from the
 *  motion: frames of loops that have no depth of their own are triangulated against frames nearby.
 *  Deterministic, with any number of threads. Not thread-safe: one caller at a time. */
class MapBuilder
{
 public:
    /** \throw std::invalid_argument on bad options. */
    MapBuilder(const TDetectorOptions& detector_options, const TGraphOptions& graph_options);

    /** To be called for every entry of the rawlog, in its order, before it is given to a stream. */
    void feed(const mrpt::obs::CObservation& observation) { recorder_.feed(observation); }
    void feed(const mrpt::obs::CActionCollection& actions) { recorder_.feed(actions); }

    /** A camera frame, after its observation was fed. */
    void add_frame(FrameId frame, double timestamp);

    /** The detector's answer for one of these frames, in their order. */
    void add(const DetectorOutcome& outcome);

    /** The map of all so far.
     *  \param places  of the stream that gave the outcomes, with the same options.
     *  \param check_cancelled  called again and again, by several threads at a time; what it throws
     *  ends the
     *         work and is thrown on.
     *  \param times receives "trajectory", "visual_odometry", "motion_agreement", "motion_depth",
     *         "graph", and the stages of the pairs of frames that were looked at. */
    Map build(
        const PlaceMap& places,
        StageTimes& times,
        const CheckCancelled& check_cancelled = [] {}) const;

 private:
    struct Loop
    {
        FrameId candidate{};
        FrameId query{};
        std::optional<RelativePose> pose;
    };

    Trajectory image_motion(const PlaceMap& places,
                            StageTimes& times,
                            const CheckCancelled& check_cancelled) const;
    LoopEdge edge_of(const Loop& loop, const PlaceMap& places) const;
    void scale_by_motion(Map& map,
                         const PlaceMap& places,
                         StageTimes& times,
                         const CheckCancelled& check_cancelled) const;
    void solve(Map& map,
               const MotionEstimate& estimate,
               const CheckCancelled& check_cancelled) const;

    TDetectorOptions detector_options_;
    TGraphOptions graph_options_;
    MotionRecorder recorder_;
    std::vector<Loop> loops_;
    FrameId end_{};  ///< the frame after the last one
};

}  // namespace fild
