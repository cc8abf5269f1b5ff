// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/graph/graph_options.h"
#include "fild/graph/trajectory.h"

#include <memory>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
}  // namespace mrpt::obs

namespace fild
{
struct GpsRecord;

/** Gathers what the sensors of a recording, other than its cameras, tell of the robot's motion.
 *  Memory grows with the number of frames, once for each receiver, and of GPS fixes; of odometry as
 *  that of TrajectoryBuilder. Deterministic. Not thread-safe: one caller at a time. */
class MotionRecorder
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit MotionRecorder(const TGraphOptions& options);
    MotionRecorder(const MotionRecorder&) = delete;
    MotionRecorder& operator=(const MotionRecorder&) = delete;
    ~MotionRecorder();

    /** To be called for every entry of the rawlog, in its order; most are passed over. */
    void feed(const mrpt::obs::CObservation& observation);
    void feed(const mrpt::obs::CActionCollection& actions);

    /** A camera frame at its place among the observations, after its observation was fed. Ids must
     *  increase. \throw std::invalid_argument when they do not. */
    void add_frame(FrameId frame, double timestamp);

    /** By the one odometry that is used, see TrajectoryBuilder. */
    Trajectory odometry() const;

    /** By all GPS receivers. */
    GpsRecord gps() const;

    /** The robot's poses by the first, most certain receiver alone. GGA fixes become metres east,
     *  north and up of the first plausible one. */
    Trajectory gps_alone() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace fild
