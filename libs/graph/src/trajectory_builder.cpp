// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/trajectory_builder.h"

#include "fild/core/angle.h"
#include "motion_readings.h"
#include "trajectory_frame.h"
#include "wheel_model.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
/** The robot's pose at one moment. */
struct Reading
{
    double seconds = 0;
    UncertainPose at;
};

/** A GPS antenna's position at one moment. */
struct Position
{
    double seconds = 0;
    Eigen::Vector3d map_from_antenna;
    GpsFix fix;
};

/** A camera frame, and how many readings there were before it. */
struct AwaitedFrame
{
    FrameId id{};
    double timestamp = 0;
    std::size_t arrival = 0;
};

/** Readings [begin, end) whose times grow. */
struct ClockRun
{
    std::size_t begin = 0;
    std::size_t end = 0;
};

/** The pose at a share, in [0, 1], of the way from a to b. */
Rigid between(const Rigid& a, const Rigid& b, double share)
{
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(a.rotation).slerp(share, Eigen::Quaterniond(b.rotation));
    return {turn.normalized().toRotationMatrix(),
            a.translation + share * (b.translation - a.translation)};
}

UncertainPose between(const UncertainPose& a, const UncertainPose& b, double share)
{
    UncertainPose result = b;
    result.map_from_robot = between(a.map_from_robot, b.map_from_robot, share);
    result.accumulated = a.accumulated + share * (b.accumulated - a.accumulated);
    if (a.absolute && b.absolute)
        result.absolute = *a.absolute + share * (*b.absolute - *a.absolute);
    return result;
}

/** Of readings with growing times, those around a time: the first of the two. */
std::size_t reading_before(const std::vector<Reading>& readings, ClockRun run, double seconds)
{
    const auto begin = readings.begin() + static_cast<std::ptrdiff_t>(run.begin);
    const auto end = readings.begin() + static_cast<std::ptrdiff_t>(run.end);
    const auto after =
        std::upper_bound(begin,
                         end,
                         seconds,
                         [](double wanted, const Reading& each) { return wanted < each.seconds; });
    const auto last = end - 1;
    return static_cast<std::size_t>((after == begin ? begin : std::min(after, last) - 1) -
                                    readings.begin());
}

/** The pose at a time of a run of readings, and the reading that is next to it. */
struct Found
{
    UncertainPose at;
    std::size_t reading = 0;
};

/** Nothing when the time is in a gap, or too far before or after the run. */
std::optional<Found> pose_in_run(const std::vector<Reading>& readings,
                                 ClockRun run,
                                 double seconds,
                                 double max_gap)
{
    const auto alone = [&](std::size_t i) -> std::optional<Found>
    {
        if (std::abs(readings[i].seconds - seconds) > max_gap) return std::nullopt;
        return Found{readings[i].at, i};
    };
    if (run.end - run.begin == 1) return alone(run.begin);
    const auto i = std::max(run.begin, reading_before(readings, run, seconds));
    const auto& a = readings[i];
    const auto& b = readings[i + 1];
    if (seconds <= a.seconds) return alone(i);
    if (seconds >= b.seconds) return alone(i + 1);
    if (b.seconds - a.seconds > max_gap || a.at.segment != b.at.segment) return std::nullopt;
    return Found{between(a.at, b.at, (seconds - a.seconds) / (b.seconds - a.seconds)), i};
}
}  // namespace

struct TrajectoryBuilder::State
{
    explicit State(const TGraphOptions& checked_options) : options(checked_options) {}

    bool is_source(const std::string& name, const std::string& label);
    bool is_usable(double seconds);
    void add_pose(double seconds, const PoseReading& reading);
    void add_movement(const MovementReading& reading);
    void place_pending_movement(double seconds);
    void add_fix(double seconds, const GpsFix& fix);
    bool is_reset(const Rigid& before, const Rigid& now, double seconds) const;
    void push(double seconds, UncertainPose pose);
    void begin_segment(UncertainPose& pose);

    TGraphOptions options;
    TrajectoryReport report;
    std::set<std::string> other_sources;
    std::vector<Reading> readings;
    std::vector<Position> positions;
    std::vector<ClockRun> runs;  ///< of readings, or of positions
    std::optional<double> last_seconds;
    std::optional<Rigid> last_raw;  ///< as the sensor told it
    std::optional<double> last_observation_seconds;  ///< of any sensor
    UncertainPose current;
    bool is_movement_pending = false;
    std::vector<AwaitedFrame> frames;
};

namespace
{
std::string describe(const std::string& class_name, const std::string& label)
{
    constexpr std::size_t kPrefix = std::char_traits<char>::length("mrpt::obs::");
    return class_name.substr(kPrefix) + (label.empty() ? "" : " '" + label + "'");
}

double seconds_of(const mrpt::obs::CObservation& observation)
{
    return mrpt::Clock::toDouble(observation.timestamp);
}
}  // namespace

/** True for readings of the one source that is used; the first one becomes it. */
bool TrajectoryBuilder::State::is_source(const std::string& name, const std::string& label)
{
    const bool is_wanted =
        options.motion_sensor_label.empty() || options.motion_sensor_label == label;
    if (is_wanted && report.source.empty()) report.source = name;
    if (is_wanted && report.source == name) return true;
    other_sources.insert(name);
    return false;
}

/** Notes gaps and jumps of the clock; false for a reading that comes late. */
bool TrajectoryBuilder::State::is_usable(double seconds)
{
    constexpr double kLate = 1;  // s; further back is another clock
    const auto index =
        options.motion_source == MotionSource::gps ? positions.size() : readings.size();
    if (last_seconds && seconds <= *last_seconds && seconds > *last_seconds - kLate)
    {
        ++report.late_readings;
        return false;
    }
    const bool jumps = last_seconds && seconds < *last_seconds;
    if (jumps) ++report.clock_jumps;
    if (!jumps && last_seconds && seconds - *last_seconds > options.max_gap_s) ++report.gaps;
    if (jumps || runs.empty()) runs.push_back({index, index});
    runs.back().end = index + 1;
    last_seconds = seconds;
    ++report.readings;
    return true;
}

bool TrajectoryBuilder::State::is_reset(const Rigid& before, const Rigid& now, double seconds) const
{
    constexpr double kJitter = 1;  // m, where two time stamps are too close
    constexpr double kAway = 0.1;  // m and rad: not at its origin
    const double elapsed =
        last_seconds && seconds > *last_seconds ? seconds - *last_seconds : options.max_gap_s;
    const double moved = (now.translation - before.translation).norm();
    const bool begins_anew = tangent_of(now).norm() == 0 && tangent_of(before).norm() > kAway;
    return begins_anew || moved > options.max_speed_m_per_s * elapsed + kJitter;
}

void TrajectoryBuilder::State::begin_segment(UncertainPose& pose)
{
    ++report.resets;
    ++pose.segment;
}

void TrajectoryBuilder::State::push(double seconds, UncertainPose pose)
{
    current = std::move(pose);
    readings.push_back({seconds, current});
}

void TrajectoryBuilder::State::add_pose(double seconds, const PoseReading& reading)
{
    if (!reading.pose.translation.allFinite() || !reading.pose.rotation.allFinite() ||
        !std::isfinite(seconds))
    {
        ++report.unusable_readings;
        return;
    }
    const Rigid before = last_raw.value_or(reading.pose);
    const bool reset = is_reset(before, reading.pose, seconds);
    if (!is_usable(seconds)) return;
    auto next = current;
    const Rigid movement = reset ? Rigid() : before.inverse() * reading.pose;
    if (reset) begin_segment(next);
    next.map_from_robot = current.map_from_robot * movement;
    const Matrix6 to_map = adjoint(next.map_from_robot);
    next.accumulated +=
        to_map * movement_covariance(options, movement, reading.is_planar) * to_map.transpose();
    next.absolute.reset();
    if (options.odometry_covariance == OdometryCovariance::own) next.absolute = reading.covariance;
    next.planar_attitude = reading.is_planar ? options.planar_attitude_deg * kRadiansPerDegree : 0;
    last_raw = reading.pose;
    push(seconds, next);
}

void TrajectoryBuilder::State::add_movement(const MovementReading& reading)
{
    if (!reading.movement.translation.allFinite() || !reading.movement.rotation.allFinite())
    {
        ++report.unusable_readings;
        return;
    }
    if (readings.empty() && last_observation_seconds && is_usable(*last_observation_seconds))
        push(*last_observation_seconds, current);
    current.map_from_robot = current.map_from_robot * reading.movement;
    const bool is_own =
        options.odometry_covariance == OdometryCovariance::own && reading.covariance.has_value();
    const Matrix6 covariance =
        is_own ? *reading.covariance
               : movement_covariance(options, reading.movement, reading.is_planar);
    const Matrix6 to_map = adjoint(current.map_from_robot);
    current.accumulated += to_map * covariance * to_map.transpose();
    current.planar_attitude =
        reading.is_planar ? options.planar_attitude_deg * kRadiansPerDegree : 0;
    is_movement_pending = true;
}

/** Where the actions led is where the first observation after them was made. */
void TrajectoryBuilder::State::place_pending_movement(double seconds)
{
    const bool is_last = !readings.empty() && last_seconds == seconds;
    if (is_last)
        readings.back().at = current;  // several actions before one time stamp
    else if (is_usable(seconds))
        push(seconds, current);
    else
        return;  // it waits for a time that can be used
    is_movement_pending = false;
}

void TrajectoryBuilder::State::add_fix(double seconds, const GpsFix& fix)
{
    if (!is_usable(seconds)) return;
    const auto& origin = positions.empty() ? fix : positions.front().fix;
    positions.push_back({seconds, local_position(fix, origin), fix});
}

namespace
{
/** Direction of the movement about a position, radians from the x axis (east), where the positions
 *  around it are a baseline apart. */
std::optional<double> heading_at(const std::vector<Position>& positions,
                                 std::size_t index,
                                 double baseline)
{
    const auto away = [&](const Position& other)
    {
        const Eigen::Vector3d way = other.map_from_antenna - positions[index].map_from_antenna;
        return way.head<2>().norm() >= baseline / 2;
    };
    std::size_t before = index;
    while (before > 0 && !away(positions[before])) --before;
    std::size_t after = index;
    while (after + 1 < positions.size() && !away(positions[after])) ++after;
    const Eigen::Vector2d way =
        (positions[after].map_from_antenna - positions[before].map_from_antenna).head<2>();
    if (way.norm() < baseline / 2) return std::nullopt;
    return std::atan2(way.y(), way.x());
}

/** Headings at all positions; where there is none, that of the nearest one (by count) before, or
 *  else after. Nothing when the robot never moved a baseline. */
std::vector<std::optional<double>> headings_of(const std::vector<Position>& positions,
                                               double baseline)
{
    std::vector<std::optional<double>> headings;
    headings.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        headings.push_back(heading_at(positions, i, baseline));
    for (std::size_t i = 1; i < headings.size(); ++i)
        if (!headings[i]) headings[i] = headings[i - 1];
    for (std::size_t i = headings.size(); i-- > 1;)
        if (!headings[i - 1]) headings[i - 1] = headings[i];
    return headings;
}

/** Covariance of a GPS pose along the map's axes. */
Matrix6 gps_covariance(const TGraphOptions& options, const Position& position, bool has_heading)
{
    constexpr double kVertical = 2;  // times the horizontal, as is usual
    constexpr double kAnyHeading = 3.14159265358979323846;
    const double sigma = options.gps_sigma_m * position.fix.hdop;
    const double attitude = options.planar_attitude_deg * kRadiansPerDegree;
    const double heading =
        has_heading ? std::min(kAnyHeading, std::sqrt(2.0) * sigma / options.gps_heading_baseline_m)
                    : kAnyHeading;
    Vector6 deviations;
    deviations << sigma, sigma, kVertical * sigma, attitude, attitude, heading;
    return deviations.cwiseAbs2().asDiagonal();
}

std::vector<Reading> readings_of_gps(const std::vector<Position>& positions,
                                     const TGraphOptions& options)
{
    const auto headings = headings_of(positions, options.gps_heading_baseline_m);
    std::vector<Reading> readings;
    readings.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
        const auto& position = positions[i];
        Reading reading{position.seconds, {}};
        auto& pose = reading.at.map_from_robot;
        pose.rotation =
            Eigen::AngleAxisd(headings[i].value_or(0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
        pose.translation =
            position.map_from_antenna - pose.rotation * position.fix.antenna_on_robot;
        reading.at.absolute = gps_covariance(options, position, headings[i].has_value());
        readings.push_back(reading);
    }
    return readings;
}

/** The frame's pose out of the run that has its time; of several, of the one fed nearest to it. */
std::optional<UncertainPose> pose_at(const std::vector<Reading>& readings,
                                     const std::vector<ClockRun>& runs,
                                     const AwaitedFrame& frame,
                                     double max_gap)
{
    std::optional<Found> best;
    const auto distance = [&](const Found& found)
    {
        return found.reading > frame.arrival ? found.reading - frame.arrival
                                             : frame.arrival - found.reading;
    };
    for (const auto& run : runs)
    {
        auto found = pose_in_run(readings, run, frame.timestamp, max_gap);
        if (found && (!best || distance(*found) < distance(*best))) best = std::move(found);
    }
    if (!best) return std::nullopt;
    return best->at;
}
}  // namespace

TrajectoryBuilder::TrajectoryBuilder(const TGraphOptions& options)
{
    options.check();
    state_ = std::make_unique<State>(options);
}

TrajectoryBuilder::~TrajectoryBuilder() = default;

void TrajectoryBuilder::feed(const mrpt::obs::CObservation& observation)
{
    const bool has_time = observation.timestamp != INVALID_TIMESTAMP;
    if (has_time && state_->is_movement_pending)
        state_->place_pending_movement(seconds_of(observation));
    if (has_time) state_->last_observation_seconds = seconds_of(observation);
    const bool wants_gps = state_->options.motion_source == MotionSource::gps;
    const auto reading = wants_gps ? std::nullopt : pose_reading_of(observation);
    if (!reading && !(wants_gps && is_gps(observation))) return;
    const auto name = describe(observation.GetRuntimeClass()->className, observation.sensorLabel);
    if (!state_->is_source(name, observation.sensorLabel)) return;
    const auto fix = wants_gps ? gps_fix_of(observation) : std::nullopt;
    if (!has_time || (wants_gps && !fix))
        ++state_->report.unusable_readings;
    else if (fix)
        state_->add_fix(seconds_of(observation), *fix);
    else
        state_->add_pose(seconds_of(observation), *reading);
}

void TrajectoryBuilder::feed(const mrpt::obs::CActionCollection& actions)
{
    if (state_->options.motion_source == MotionSource::gps) return;
    const auto reading = movement_reading_of(actions);
    if (!reading || !state_->is_source("actions", "")) return;
    state_->add_movement(*reading);
}

void TrajectoryBuilder::add_frame(FrameId frame, double timestamp)
{
    if (!state_->frames.empty() && frame <= state_->frames.back().id)
        throw std::invalid_argument("TrajectoryBuilder::add_frame: frame " +
                                    std::to_string(to_index(frame)) + " comes after frame " +
                                    std::to_string(to_index(state_->frames.back().id)));
    state_->frames.push_back({frame, timestamp, state_->report.readings});
}

Trajectory TrajectoryBuilder::build() const
{
    const bool is_gps = state_->options.motion_source == MotionSource::gps;
    const auto readings =
        is_gps ? readings_of_gps(state_->positions, state_->options) : state_->readings;
    auto report = state_->report;
    report.other_sources.assign(state_->other_sources.begin(), state_->other_sources.end());
    std::vector<Trajectory::Frame> frames;
    for (const auto& frame : state_->frames)
    {
        const auto pose = pose_at(readings, state_->runs, frame, state_->options.max_gap_s);
        if (pose)
            frames.push_back({frame.id, frame.timestamp, *pose});
        else
            report.frames_without_pose.push_back(frame.id);
    }
    return {std::move(frames), std::move(report)};
}

}  // namespace fild
