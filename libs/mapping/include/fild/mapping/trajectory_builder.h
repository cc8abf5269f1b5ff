// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/graph/graph_options.h"
#include "fild/graph/trajectory.h"

#include <cstddef>
#include <memory>
#include <optional>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
}  // namespace mrpt::obs

namespace fild
{
/** Gathers the robot's motion by its odometry from the entries of a rawlog, and gives its pose at
 *  camera frames.
 *
 *  The first source that can serve is used throughout: CObservationOdometry,
 *  CObservationRobotPose, or actions (CActionRobotMovement2D and 3D). The pose between two readings
 *  is interpolated; before the first one and after the last one the robot moves on as it did, for
 *  as long as one reading is from the next.
 *  * Actions: they lead to the observations after them, so the pose holds at the first of these
 *    that has a time stamp (the actions' own lies half way in MRPT's recordings).
 *  * Covariances of CObservationRobotPose are absolute. Along directions in which they grow from
 *    one frame to the next, the growth counts (dead reckoning); along others both count, as for
 *    poses measured independently.
 *  * Over a gap in CObservationOdometry and CObservationRobotPose (TGraphOptions::max_gap_s) the
 *    motion is that of the readings at its ends; its covariance is that of a drive as long as the
 *    robot made in the same time before.
 *  * A clock that jumps back: the motion goes on; frames find their readings by time and, where a
 *    time comes twice, by the order in which all was fed.
 *  * An odometry that is reset, or jumps further than a robot can move
 *    (TGraphOptions::max_speed_m_per_s), begins a new segment at the last pose; so do actions that
 *    lead further.
 *
 *  Memory grows with the number of frames; of readings those since the last frame are kept, and
 *  10,000 before it at the least: a frame that is older than those has no pose.
 *  Deterministic. Not thread-safe: one caller at a time.
 */
class TrajectoryBuilder
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit TrajectoryBuilder(const TGraphOptions& options);
    TrajectoryBuilder(const TrajectoryBuilder&) = delete;
    TrajectoryBuilder& operator=(const TrajectoryBuilder&) = delete;
    ~TrajectoryBuilder();

    /** To be called for every observation of the rawlog, in its order; most are passed over. */
    void feed(const mrpt::obs::CObservation& observation);
    void feed(const mrpt::obs::CActionCollection& actions);

    /** A camera frame at its place among the observations, after its observation was fed. Ids must
     *  increase. \throw std::invalid_argument when they do not. */
    void add_frame(FrameId frame, double timestamp);

    /** Usable readings of the source so far. */
    std::size_t readings() const;

    /** Readings in memory. */
    std::size_t readings_kept() const;

    /** From the first reading to the last one, in constant time. Nothing before the second one, and
     *  when the odometry was reset between them. */
    std::optional<RelativeMotion> motion_so_far() const;

    /** The poses of the frames so far. Costs time in proportion to readings and frames. */
    Trajectory build() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fild
