// SPDX-License-Identifier: BSD-3-Clause
#include "gps_track.h"

#include "fild/core/angle.h"
#include "gps_headings.h"

#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
/** Covariance of a GPS pose along the map's axes. */
Matrix6 pose_covariance(const TGraphOptions& options,
                        double sigma,
                        const std::optional<Heading>& heading)
{
    constexpr double kAnyHeading = 180 * kRadiansPerDegree;
    const double attitude = options.planar_attitude_deg * kRadiansPerDegree;
    const double turn =
        heading ? std::min(kAnyHeading, std::sqrt(2.0) * sigma / heading->baseline) : kAnyHeading;
    Vector6 deviations;
    deviations << sigma, sigma, kVerticalOfHorizontal * sigma, attitude, attitude, turn;
    return deviations.cwiseAbs2().asDiagonal();
}

std::vector<TimedReading> readings_of(const GpsTrack& track, const TGraphOptions& options)
{
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(track.positions.size());
    for (const auto& position : track.positions) positions.push_back(position.map_from_antenna);
    const auto headings = headings_of(positions, options.gps_heading_baseline_m);
    std::vector<TimedReading> readings;
    readings.reserve(track.positions.size());
    for (std::size_t i = 0; i < track.positions.size(); ++i)
    {
        const auto& position = track.positions[i];
        TimedReading reading{position.seconds, {}};
        auto& pose = reading.at.map_from_robot;
        pose.rotation =
            Eigen::AngleAxisd(headings[i].value_or(Heading()).angle, Eigen::Vector3d::UnitZ())
                .toRotationMatrix();
        pose.translation = position.map_from_antenna - pose.rotation * position.robot_from_antenna;
        reading.at.absolute = pose_covariance(options, position.sigma_m, headings[i]);
        reading.at.is_independent = true;
        readings.push_back(reading);
    }
    return readings;
}
}  // namespace

void GpsReceiver::feed(const mrpt::obs::CObservation& observation)
{
    if (!has_gga(observation)) ++without_gga_;
    const auto fix = gps_fix_of(observation);
    if (!fix || observation.timestamp == INVALID_TIMESTAMP)
    {
        ++unusable_;
        return;
    }
    const double seconds = mrpt::Clock::toDouble(observation.timestamp);
    if (clock_.accept(seconds)) fixes_.push_back({seconds, *fix});
}

GpsTrack GpsReceiver::track(const std::vector<bool>& plausible,
                            const EastNorthUp& map,
                            const std::vector<AwaitedFrame>& frames) const
{
    GpsTrack track;
    std::vector<std::size_t> before;  // of each fix: how many positions
    for (std::size_t i = 0; i < fixes_.size(); ++i)
    {
        before.push_back(track.positions.size());
        if (!plausible[i]) continue;
        const auto& [seconds, fix] = fixes_[i];
        const auto position = map.position_of(fix.place);
        const auto& antenna = fix.robot_from_antenna;
        track.positions.push_back({seconds,
                                   {position[0], position[1], position[2]},
                                   horizontal_sigma(fix, options_),
                                   {antenna[0], antenna[1], antenna[2]}});
    }
    before.push_back(track.positions.size());
    for (const auto& run : clock_.runs())
    {
        const ClockRun kept{before[run.begin], before[run.end]};
        if (kept.begin < kept.end) track.runs.push_back(kept);
    }
    for (const auto& frame : frames)
        track.frames.push_back({frame.id, frame.timestamp, before[frame.arrival]});
    auto& report = track.report;
    report.source = name_;
    report.readings = track.positions.size();
    report.implausible_readings = fixes_.size() - track.positions.size();
    report.unusable_readings = unusable_;
    report.fixes_without_gga = without_gga_;
    report.late_readings = clock_.late();
    report.gaps = clock_.gaps();
    report.clock_jumps = clock_.jumps();
    return track;
}

Trajectory trajectory_of(const GpsTrack& track, const TGraphOptions& options)
{
    const auto readings = readings_of(track, options);
    auto report = track.report;
    std::vector<Trajectory::Frame> placed;
    for (const auto& frame : track.frames)
    {
        const auto found = pose_at({readings, track.runs}, frame, options.max_gap_s);
        if (found)
            placed.push_back({frame.id, frame.timestamp, found->at});
        else
            report.frames_without_pose.push_back(frame.id);
    }
    return {std::move(placed), std::move(report)};
}

}  // namespace fild
