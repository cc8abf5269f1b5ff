// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/trajectory_builder.h"

#include "fild/core/angle.h"
#include "fild/core/utf8.h"
#include "motion_readings.h"
#include "plausible_fixes.h"
#include "trajectory_frame.h"
#include "wheel_model.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
constexpr auto kAllReadings = std::numeric_limits<std::size_t>::max();
constexpr double kHalfTurn = 180 * kRadiansPerDegree;

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

/** What the poses told outside of gaps. */
struct Driven
{
    double seconds = 0;
    double way = 0;  ///< metres
    double turn = 0;  ///< radians, left and right alike

    void add(const Rigid& movement, double elapsed)
    {
        seconds += elapsed;
        way += movement.translation.norm();
        turn += tangent_of(movement).tail<3>().norm();
    }
};

/** The pose at a time of a run of readings, and the reading that is next to it. */
struct Found
{
    UncertainPose at;
    std::size_t reading = 0;
};

/** A camera frame, and how many readings there were before it. */
struct AwaitedFrame
{
    FrameId id{};
    double timestamp = 0;
    std::size_t arrival = 0;
    std::optional<Found> found{};  ///< among the readings that are forgotten
};

/** Readings [begin, end) whose times grow. */
struct ClockRun
{
    std::size_t begin = 0;
    std::size_t end = 0;
    bool is_cut = false;  ///< the readings before `begin` are forgotten
};

/** Readings in the order of the recording, without the first `forgotten` ones. */
struct KeptReadings
{
    std::vector<Reading> readings;
    std::vector<ClockRun> runs;  ///< of readings, or of fixes
    std::size_t forgotten = 0;

    void forget(std::size_t count);
};

void KeptReadings::forget(std::size_t count)
{
    readings.erase(readings.begin(), readings.begin() + static_cast<std::ptrdiff_t>(count));
    forgotten += count;
    std::vector<ClockRun> left;
    for (const auto& run : runs)
    {
        if (run.end <= count) continue;
        const bool is_cut = run.is_cut || run.begin < count;
        left.push_back({std::max(run.begin, count) - count, run.end - count, is_cut});
    }
    runs = std::move(left);
}

/** The pose at a share of the way from a to b; below 0 and above 1 as if the robot moved on. */
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
    const double inside = std::clamp(share, 0.0, 1.0);
    if (a.absolute && b.absolute)
        result.absolute = *a.absolute + inside * (*b.absolute - *a.absolute);
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

/** Before the first and after the last reading the robot moves on as it did, for as long as one
 *  reading is from the next. Nothing further away, or in a gap. */
std::optional<Found> pose_in_run(const std::vector<Reading>& readings,
                                 ClockRun run,
                                 double seconds,
                                 double max_gap)
{
    constexpr double kSameMoment = 0.1;  // s
    const auto alone = [&](std::size_t i) -> std::optional<Found>
    {
        if (std::abs(readings[i].seconds - seconds) > kSameMoment) return std::nullopt;
        return Found{readings[i].at, i};
    };
    if (run.is_cut && seconds < readings[run.begin].seconds) return std::nullopt;
    if (run.end - run.begin == 1) return alone(run.begin);
    const auto i = std::max(run.begin, reading_before(readings, run, seconds));
    const auto& a = readings[i];
    const auto& b = readings[i + 1];
    const double interval = b.seconds - a.seconds;
    if (interval > max_gap || a.at.segment != b.at.segment)
        return alone(seconds - a.seconds < b.seconds - seconds ? i : i + 1);
    const double share = (seconds - a.seconds) / interval;
    if (share < -1 || share > 2) return std::nullopt;
    return Found{between(a.at, b.at, share), share > 1 ? i + 1 : i};
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
    std::optional<Rigid> hidden_movement(double seconds) const;
    bool is_too_fast(const Rigid& before, const Rigid& now, double seconds) const;
    bool is_reset(const Rigid& before, const Rigid& now, double seconds) const;
    void push(double seconds, UncertainPose pose);
    void forget_readings();
    void begin_segment(UncertainPose& pose);

    TGraphOptions options;
    TrajectoryReport report;
    std::set<std::string> other_sources;
    KeptReadings kept;
    std::optional<Reading> first_reading;  ///< when it is forgotten
    std::vector<TimedFix> fixes;
    std::optional<double> last_seconds;
    std::optional<Rigid> last_raw;  ///< as the sensor told it
    Driven driven;
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
        options.motion_source == MotionSource::gps ? fixes.size() : kept.readings.size();
    if (last_seconds && seconds <= *last_seconds && seconds > *last_seconds - kLate)
    {
        ++report.late_readings;
        return false;
    }
    const bool jumps = last_seconds && seconds < *last_seconds;
    if (jumps) ++report.clock_jumps;
    if (!jumps && last_seconds && seconds - *last_seconds > options.max_gap_s) ++report.gaps;
    if (jumps || kept.runs.empty()) kept.runs.push_back({index, index});
    kept.runs.back().end = index + 1;
    last_seconds = seconds;
    ++report.readings;
    return true;
}

bool TrajectoryBuilder::State::is_too_fast(const Rigid& before,
                                           const Rigid& now,
                                           double seconds) const
{
    constexpr double kJitter = 1;  // m, where two time stamps are too close
    const double elapsed =
        last_seconds && seconds > *last_seconds ? seconds - *last_seconds : options.max_gap_s;
    const double moved = (now.translation - before.translation).norm();
    return moved > options.max_speed_m_per_s * elapsed + kJitter;
}

bool TrajectoryBuilder::State::is_reset(const Rigid& before, const Rigid& now, double seconds) const
{
    constexpr double kAway = 0.1;  // m and rad: not at its origin
    const bool begins_anew = tangent_of(now).norm() == 0 && tangent_of(before).norm() > kAway;
    return begins_anew || is_too_fast(before, now, seconds);
}

/** What the robot may have driven in a gap before a reading, where its ends may lie side by side:
 *  as far and with as many turns as in the same time before. Nothing where there is no gap. */
std::optional<Rigid> TrajectoryBuilder::State::hidden_movement(double seconds) const
{
    if (!last_seconds || seconds - *last_seconds <= options.max_gap_s || driven.seconds <= 0)
        return std::nullopt;
    const double share = (seconds - *last_seconds) / driven.seconds;
    const double turn = std::min(share * driven.turn, kHalfTurn);
    return Rigid{Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                 {share * driven.way, 0, 0}};
}

void TrajectoryBuilder::State::begin_segment(UncertainPose& pose)
{
    ++report.resets;
    ++pose.segment;
}

void TrajectoryBuilder::State::push(double seconds, UncertainPose pose)
{
    current = std::move(pose);
    kept.readings.push_back({seconds, current});
    forget_readings();
}

namespace
{
/** The frame's pose out of the run that has its time; of several, of the one fed nearest to it.
 *  Only at readings up to number `last`. */
std::optional<Found> pose_at(const KeptReadings& kept,
                             const AwaitedFrame& frame,
                             double max_gap,
                             std::size_t last)
{
    auto best = frame.found;
    const auto distance = [&](const Found& found)
    {
        return found.reading > frame.arrival ? found.reading - frame.arrival
                                             : frame.arrival - found.reading;
    };
    for (const auto& run : kept.runs)
    {
        auto found = pose_in_run(kept.readings, run, frame.timestamp, max_gap);
        if (!found) continue;
        found->reading += kept.forgotten;
        if (found->reading > last) continue;
        if (!best || distance(*found) < distance(*best)) best = std::move(found);
    }
    return best;
}
}  // namespace

/** Frames that come later need the readings since the last frame, and a late camera some before
 *  it. Frames that are there keep what they found at the others. */
void TrajectoryBuilder::State::forget_readings()
{
    constexpr std::size_t kLateReadings = 10000;
    const auto needed = kept.forgotten + 2 * kLateReadings;
    if (frames.empty() || frames.back().arrival < needed) return;
    if (!first_reading) first_reading = kept.readings.front();
    const auto first_kept = frames.back().arrival - kLateReadings;
    for (auto& frame : frames) frame.found = pose_at(kept, frame, options.max_gap_s, first_kept);
    kept.forget(first_kept - kept.forgotten);
}

namespace
{
/** A covariance along other axes, for position and rotation vector alike. */
Matrix6 turned(const Matrix6& covariance, const Eigen::Matrix3d& rotation)
{
    Matrix6 turn = Matrix6::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = rotation;
    return turn * covariance * turn.transpose();
}
}  // namespace

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
    const auto hidden = hidden_movement(seconds);
    const double elapsed = last_seconds ? seconds - *last_seconds : 0;
    if (!is_usable(seconds)) return;
    auto next = current;
    const Rigid movement = reset ? Rigid() : before.inverse() * reading.pose;
    if (reset) begin_segment(next);
    next.map_from_robot = current.map_from_robot * movement;
    const Matrix6 to_map = adjoint(next.map_from_robot);
    Matrix6 covariance = movement_covariance(options, movement, reading.is_planar);
    if (hidden)
        covariance += movement_covariance(options, *hidden, reading.is_planar);
    else if (!reset && elapsed > 0)
        driven.add(movement, elapsed);
    next.accumulated += to_map * covariance * to_map.transpose();
    next.absolute.reset();
    if (options.odometry_covariance == OdometryCovariance::own && reading.covariance)
        next.absolute = turned(*reading.covariance,
                               next.map_from_robot.rotation * reading.pose.rotation.transpose());
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
    if (kept.readings.empty() && last_observation_seconds && is_usable(*last_observation_seconds))
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
    const bool is_last = !kept.readings.empty() && last_seconds == seconds;
    if (!kept.readings.empty() &&
        is_too_fast(kept.readings.back().at.map_from_robot, current.map_from_robot, seconds))
    {
        current = kept.readings.back().at;
        begin_segment(current);
    }
    if (is_last)
        kept.readings.back().at = current;  // several actions before one time stamp
    else if (is_usable(seconds))
        push(seconds, current);
    else
        return;  // it waits for a time that can be used
    is_movement_pending = false;
}

namespace
{
/** Direction of a movement. */
struct Heading
{
    double angle = 0;  ///< radians from the x axis (east)
    double baseline = 0;  ///< metres that the movement goes
};

/** Boxes around each 256 positions in a row: while the robot is parked whole blocks are near. */
class PositionBlocks
{
 public:
    explicit PositionBlocks(const std::vector<Position>& positions) : count_(positions.size())
    {
        for (std::size_t i = 0; i < count_; ++i)
        {
            if (i % kBlock == 0) boxes_.emplace_back();
            boxes_.back().extend(Eigen::Vector2d(positions[i].map_from_antenna.head<2>()));
        }
    }

    /** True when all positions of the block are nearer than `radius`. */
    bool is_within(std::size_t position, const Eigen::Vector2d& centre, double radius) const
    {
        const auto& box = boxes_[position / kBlock];
        const Eigen::Vector2d furthest =
            (centre - box.min()).cwiseAbs().cwiseMax((centre - box.max()).cwiseAbs());
        return furthest.norm() < radius;
    }

    /** The last position before the block; 0 when there is none. */
    std::size_t before(std::size_t position) const
    {
        const auto begin = position / kBlock * kBlock;
        return begin > 0 ? begin - 1 : 0;
    }

    /** The first position after the block; the last one when there is none. */
    std::size_t after(std::size_t position) const
    {
        return std::min((position / kBlock + 1) * kBlock, count_ - 1);
    }

 private:
    static constexpr std::size_t kBlock = 256;

    std::size_t count_;
    std::vector<Eigen::AlignedBox2d> boxes_;
};

/** Direction of the movement about a position, where the positions around it are a baseline apart,
 *  or half of one at the ends of the drive. */
std::optional<Heading> heading_at(const std::vector<Position>& positions,
                                  const PositionBlocks& blocks,
                                  std::size_t index,
                                  double baseline)
{
    const Eigen::Vector2d here = positions[index].map_from_antenna.head<2>();
    const auto is_away = [&](std::size_t other)
    { return (positions[other].map_from_antenna.head<2>() - here).norm() >= baseline / 2; };
    std::size_t before = index;
    while (before > 0 && !is_away(before))
        before = blocks.is_within(before, here, baseline / 2) ? blocks.before(before) : before - 1;
    std::size_t after = index;
    while (after + 1 < positions.size() && !is_away(after))
        after = blocks.is_within(after, here, baseline / 2) ? blocks.after(after) : after + 1;
    const Eigen::Vector2d way =
        (positions[after].map_from_antenna - positions[before].map_from_antenna).head<2>();
    if (way.norm() < baseline / 2) return std::nullopt;
    return Heading{std::atan2(way.y(), way.x()), way.norm()};
}

/** Headings at all positions; where there is none, that of the nearest one (by count) before, or
 *  else after. Nothing when the robot never moved a baseline. */
std::vector<std::optional<Heading>> headings_of(const std::vector<Position>& positions,
                                                double baseline)
{
    std::vector<std::optional<Heading>> headings;
    headings.reserve(positions.size());
    const PositionBlocks blocks(positions);
    for (std::size_t i = 0; i < positions.size(); ++i)
        headings.push_back(heading_at(positions, blocks, i, baseline));
    for (std::size_t i = 1; i < headings.size(); ++i)
        if (!headings[i]) headings[i] = headings[i - 1];
    for (std::size_t i = headings.size(); i-- > 1;)
        if (!headings[i - 1]) headings[i - 1] = headings[i];
    return headings;
}

/** Covariance of a GPS pose along the map's axes. */
Matrix6 gps_covariance(const TGraphOptions& options,
                       const Position& position,
                       const std::optional<Heading>& heading)
{
    constexpr double kVertical = 2;  // times the horizontal, as is usual
    constexpr double kAnyHeading = 3.14159265358979323846;
    const double sigma = options.gps_sigma_m * position.fix.hdop;
    const double attitude = options.planar_attitude_deg * kRadiansPerDegree;
    const double turn =
        heading ? std::min(kAnyHeading, std::sqrt(2.0) * sigma / heading->baseline) : kAnyHeading;
    Vector6 deviations;
    deviations << sigma, sigma, kVertical * sigma, attitude, attitude, turn;
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
            Eigen::AngleAxisd(headings[i].value_or(Heading()).angle, Eigen::Vector3d::UnitZ())
                .toRotationMatrix();
        pose.translation =
            position.map_from_antenna - pose.rotation * position.fix.antenna_on_robot;
        reading.at.absolute = gps_covariance(options, position, headings[i]);
        reading.at.is_independent = true;
        readings.push_back(reading);
    }
    return readings;
}

/** What poses of frames are found in. */
struct PoseSource
{
    KeptReadings kept;
    std::vector<std::size_t> arrivals;  ///< of all fixes: how many readings there were before
    std::size_t left_out = 0;  ///< fixes
};

/** Readings of the plausible fixes, positions from the first of them on. */
PoseSource source_of_gps(const std::vector<TimedFix>& fixes,
                         const std::vector<ClockRun>& runs,
                         const TGraphOptions& options)
{
    const auto plausible = plausible_fixes(fixes, options);
    PoseSource source;
    std::vector<Position> positions;
    for (std::size_t i = 0; i < fixes.size(); ++i)
    {
        source.arrivals.push_back(positions.size());
        if (!plausible[i]) continue;
        const auto& [seconds, fix] = fixes[i];
        const auto origin = positions.empty() ? fix : positions.front().fix;
        positions.push_back({seconds, local_position(fix, origin), fix});
    }
    source.arrivals.push_back(positions.size());
    source.left_out = fixes.size() - positions.size();
    for (const auto& run : runs)
    {
        const ClockRun kept{source.arrivals[run.begin], source.arrivals[run.end]};
        if (kept.begin < kept.end) source.kept.runs.push_back(kept);
    }
    source.kept.readings = readings_of_gps(positions, options);
    return source;
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
    const bool is_fix = is_gps(observation);
    const auto reading = pose_reading_of(observation);
    if (!reading && !is_fix) return;
    const auto label = as_utf8(observation.sensorLabel);
    const auto name = describe(observation.GetRuntimeClass()->className, label);
    if (is_fix != wants_gps)
    {
        state_->other_sources.insert(name);
        return;
    }
    if (!state_->is_source(name, label)) return;
    if (is_fix && !has_gga(observation)) ++state_->report.fixes_without_gga;
    const auto fix = is_fix ? gps_fix_of(observation) : std::nullopt;
    if (!has_time || (is_fix && !fix))
        ++state_->report.unusable_readings;
    else if (fix && state_->is_usable(seconds_of(observation)))
        state_->fixes.push_back({seconds_of(observation), *fix});
    else if (reading)
        state_->add_pose(seconds_of(observation), *reading);
}

void TrajectoryBuilder::feed(const mrpt::obs::CActionCollection& actions)
{
    const auto reading = movement_reading_of(actions);
    if (!reading) return;
    if (state_->options.motion_source == MotionSource::gps)
        state_->other_sources.insert("actions");
    else if (state_->is_source("actions", ""))
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

std::size_t TrajectoryBuilder::readings() const
{
    return state_->report.readings;
}

std::optional<RelativeMotion> TrajectoryBuilder::motion_so_far() const
{
    const auto& readings = state_->kept.readings;
    if (readings.size() < 2) return std::nullopt;
    const auto frame = [](FrameId id, const Reading& reading) {
        return Trajectory::Frame{id, reading.seconds, reading.at};
    };
    const auto& begin = state_->first_reading ? *state_->first_reading : readings.front();
    const FrameId first{0};
    const FrameId last{1};
    return Trajectory({frame(first, begin), frame(last, readings.back())}, {}).motion(first, last);
}

std::size_t TrajectoryBuilder::readings_kept() const
{
    return state_->kept.readings.size() + state_->fixes.size();
}

Trajectory TrajectoryBuilder::build() const
{
    const bool is_gps = state_->options.motion_source == MotionSource::gps;
    const auto of_gps =
        is_gps ? source_of_gps(state_->fixes, state_->kept.runs, state_->options) : PoseSource();
    const auto& kept = is_gps ? of_gps.kept : state_->kept;
    auto report = state_->report;
    report.other_sources.assign(state_->other_sources.begin(), state_->other_sources.end());
    report.implausible_readings = of_gps.left_out;
    report.readings -= of_gps.left_out;
    std::vector<Trajectory::Frame> frames;
    for (auto frame : state_->frames)
    {
        if (is_gps) frame.arrival = of_gps.arrivals[frame.arrival];
        const auto found = pose_at(kept, frame, state_->options.max_gap_s, kAllReadings);
        if (found)
            frames.push_back({frame.id, frame.timestamp, found->at});
        else
            report.frames_without_pose.push_back(frame.id);
    }
    return {std::move(frames), std::move(report)};
}

}  // namespace fild
