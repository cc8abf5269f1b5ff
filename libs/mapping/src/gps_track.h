// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/trajectory.h"
#include "plausible_fixes.h"
#include "timed_readings.h"

#include <Eigen/Core>
#include <string>
#include <vector>

namespace fild
{
/** Where a receiver's antenna was at one moment. */
struct GpsPosition
{
    double seconds = 0;
    Eigen::Vector3d map_from_antenna;  ///< metres east, north and up of the map's origin
    double sigma_m = 0;  ///< standard deviation to the east and to the north; up: twice that
    Eigen::Vector3d robot_from_antenna;
};

/** The plausible positions of one receiver. Value type. */
struct GpsTrack
{
    TrajectoryReport report;
    std::vector<GpsPosition> positions;
    std::vector<ClockRun> runs;  ///< of positions
    std::vector<AwaitedFrame> frames;  ///< all camera frames, and how many positions came before
};

/** The fixes of one receiver, in the order of the recording. */
class GpsReceiver
{
 public:
    GpsReceiver(std::string name, const TGraphOptions& options)
        : name_(std::move(name)), options_(options), clock_(options.max_gap_s)
    {
    }

    /** \param observation  CObservationGPS of this receiver. */
    void feed(const mrpt::obs::CObservation& observation);

    const std::vector<TimedFix>& fixes() const { return fixes_; }

    /** \param plausible  of each fix.
     *  \param frames  and how many fixes there were before each. */
    GpsTrack track(const std::vector<bool>& plausible,
                   const EastNorthUp& map,
                   const std::vector<AwaitedFrame>& frames) const;

 private:
    std::string name_;
    TGraphOptions options_;
    ReadingClock clock_;
    std::vector<TimedFix> fixes_;
    std::size_t unusable_ = 0;
    std::size_t without_gga_ = 0;
};

/** The robot's poses by one receiver alone. The heading is that of the movement over
 *  TGraphOptions::gps_heading_baseline_m, so a robot that drives backwards looks the wrong way;
 *  pitch and roll are 0. */
Trajectory trajectory_of(const GpsTrack& track, const TGraphOptions& options);

}  // namespace fild
