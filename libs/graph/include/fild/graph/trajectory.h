// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** How the robot moved from one frame to another. Value type. */
struct RelativeMotion
{
    mrpt::poses::CPose3D a_from_b;  ///< pose of the robot at b, seen from the robot at a
    /** Of (x y z yaw pitch roll) of `a_from_b`, metres and radians: MRPT's order, and the meaning
     *  of mrpt::poses::CPose3DPDFGaussian. Positive definite. */
    mrpt::math::CMatrixDouble66 covariance;
};

/** Where the robot was at a camera frame. Value type. */
struct TrajectoryPose
{
    FrameId frame{};
    double timestamp = 0;  ///< of the frame, seconds since the UNIX epoch
    mrpt::poses::CPose3D map_from_robot;  ///< the map begins at the first reading
    int segment = 0;  ///< between two segments the motion is unknown
};

/** What happened while a trajectory was gathered. Value type. */
struct TrajectoryReport
{
    std::string source;  ///< "CObservationOdometry 'ODOMETRY'"; empty: no reading came
    std::vector<std::string> other_sources;  ///< could have served too, not used; sorted
    std::size_t readings = 0;  ///< used
    std::size_t unusable_readings = 0;  ///< with no finite pose, no time stamp, or no GPS fix
    std::size_t fixes_without_gga = 0;  ///< of a GPS, among the unusable ones: other messages
    std::size_t implausible_readings = 0;  ///< GPS fixes that only a robot too fast can reach
    std::size_t late_readings =
        0;  ///< up to a second older than the one before, or as old: left out
    std::size_t clock_jumps = 0;  ///< the readings' clock went back by more than a second
    std::size_t gaps = 0;  ///< times without a reading for longer than TGraphOptions::max_gap_s
    std::size_t resets = 0;  ///< the odometry was reset or jumped: a new segment begins
    std::vector<FrameId> frames_without_pose;  ///< in a gap, before the first or after the last
};

/** The robot's poses at the camera frames, and what is known of the motion between them. Made by a
 *  TrajectoryBuilder. Const members may run concurrently; CPose3D::yaw() of one pose may not. */
class Trajectory
{
 public:
    struct Frame;
    Trajectory(std::vector<Frame> frames, TrajectoryReport report);
    /** The same motion, with another report. */
    Trajectory(const Trajectory& motion, TrajectoryReport report);
    Trajectory(const Trajectory&);
    Trajectory(Trajectory&&) noexcept;
    Trajectory& operator=(const Trajectory&) = delete;
    ~Trajectory();

    /** The frames that have a pose, in increasing id. */
    const std::vector<TrajectoryPose>& poses() const { return poses_; }
    /** The same with their covariances, see trajectory_frame.h. */
    const std::vector<Frame>& frames() const { return frames_; }
    const TrajectoryReport& report() const { return report_; }

    /** Nothing for a frame that has no pose. */
    std::optional<TrajectoryPose> pose(FrameId frame) const;

    /** The motion between two frames and its covariance: the readings' own, or the model of
     *  TGraphOptions. Nothing when one of them has no pose, or when they are in different segments.
     */
    std::optional<RelativeMotion> motion(FrameId a, FrameId b) const;

 private:
    const Frame* find(FrameId frame) const;

    std::vector<Frame> frames_;
    std::vector<TrajectoryPose> poses_;
    TrajectoryReport report_;
};

/** The same frames at other poses, in their order; the covariances of the motions between frames
 *  that follow each other stay as they are.
 *  \throw std::invalid_argument when there are not as many poses as frames. */
Trajectory with_poses(const Trajectory& trajectory, const std::vector<TrajectoryPose>& poses);

/** A motion that was measured between two frames, such as by vision. Value type. */
struct MeasuredMotion
{
    FrameId a{};
    FrameId b{};
    double a_timestamp = 0;
    double b_timestamp = 0;
    RelativeMotion motion;
};

/** The trajectory of a robot without odometry, from motions between frames that follow each other.
 *  Where a motion does not begin at the frame that the one before ended at, a new segment begins,
 * at the last pose. \throw std::invalid_argument when the frames do not increase, or naming them
 * when a motion is not finite or its covariance not positive definite. */
Trajectory trajectory_from_motions(const std::vector<MeasuredMotion>& motions);

}  // namespace fild
