// SPDX-License-Identifier: BSD-3-Clause
#include "dead_reckoning.h"

#include "fild/core/angle.h"
#include "plausible_speed.h"
#include "wheel_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fild
{
namespace
{
constexpr double kHalfTurn = 180 * kRadiansPerDegree;

bool is_finite(const mrpt::poses::CPose3D& pose)
{
    return std::isfinite(pose.x() + pose.y() + pose.z() + pose.yaw() + pose.pitch() + pose.roll());
}

/** Covariance of MRPT's parameters as one in the tangent. */
Matrix6 in_tangent(const mrpt::poses::CPose3D& pose, const mrpt::math::CMatrixDouble66& covariance)
{
    const Matrix6 by_parameters = tangent_by_parameters(pose);
    return by_parameters * to_eigen(covariance) * by_parameters.transpose();
}
}  // namespace

void Driven::add(const Rigid& movement, double elapsed)
{
    seconds += elapsed;
    way += movement.translation.norm();
    turn += tangent_of(movement).tail<3>().norm();
}

bool DeadReckoning::is_too_fast(const Rigid& before, const Rigid& now, double seconds) const
{
    const auto& last = clock_.last();
    const double elapsed = last && seconds > *last ? seconds - *last : options_.max_gap_s;
    const double moved = (now.translation - before.translation).norm();
    return fild::is_too_fast(moved, elapsed, options_.max_speed_m_per_s);
}

bool DeadReckoning::is_reset(const Rigid& before, const Rigid& now, double seconds) const
{
    constexpr double kAway = 0.1;  // m and rad: not at its origin
    const bool begins_anew = tangent_of(now).norm() == 0 && tangent_of(before).norm() > kAway;
    return begins_anew || is_too_fast(before, now, seconds);
}

/** What the robot may have driven in a gap before a reading, where its ends may lie side by side:
 *  as far and with as many turns as in the same time before. Nothing where there is no gap. */
std::optional<Rigid> DeadReckoning::hidden_movement(double seconds) const
{
    const auto& last = clock_.last();
    if (!last || seconds - *last <= options_.max_gap_s || driven_.seconds <= 0) return std::nullopt;
    const double share = (seconds - *last) / driven_.seconds;
    const double turn = std::min(share * driven_.turn, kHalfTurn);
    return Rigid{Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                 {share * driven_.way, 0, 0}};
}

Matrix6 DeadReckoning::covariance_of(const Rigid& movement, bool is_planar) const
{
    return movement_covariance(options_, movement, is_planar);
}

double DeadReckoning::attitude_of(bool is_planar) const
{
    return is_planar ? options_.planar_attitude_deg * kRadiansPerDegree : 0;
}

void DeadReckoning::move(const Rigid& movement, const Matrix6& covariance)
{
    current_.map_from_robot = current_.map_from_robot * movement;
    const Matrix6 to_map = adjoint(current_.map_from_robot);
    current_.accumulated += to_map * covariance * to_map.transpose();
}

void DeadReckoning::add_pose(double seconds, const PoseReading& reading)
{
    if (!is_finite(reading.pose) || !std::isfinite(seconds))
    {
        count_unusable();
        return;
    }
    const Rigid raw = to_rigid(reading.pose);
    const Rigid before = last_raw_.value_or(raw);
    const bool reset = is_reset(before, raw, seconds);
    const auto hidden = hidden_movement(seconds);
    const double elapsed = clock_.last() ? seconds - *clock_.last() : 0;
    if (!clock_.accept(seconds)) return;
    const Rigid movement = reset ? Rigid() : before.inverse() * raw;
    if (reset) ++current_.segment;
    Matrix6 covariance = covariance_of(movement, reading.is_planar);
    if (hidden)
        covariance += covariance_of(*hidden, reading.is_planar);
    else if (!reset && elapsed > 0 && elapsed <= options_.max_gap_s)
        driven_.add(movement, elapsed);
    move(movement, covariance);
    current_.absolute.reset();
    if (options_.odometry_covariance == OdometryCovariance::own && reading.covariance)
        current_.absolute =
            turned(in_tangent(reading.pose, *reading.covariance), current_.map_from_robot.rotation);
    current_.planar_attitude = attitude_of(reading.is_planar);
    last_raw_ = raw;
    readings_.push_back({seconds, current_});
}

bool DeadReckoning::add_movement(const MovementReading& reading)
{
    if (!is_finite(reading.movement))
    {
        count_unusable();
        return false;
    }
    const bool is_own =
        options_.odometry_covariance == OdometryCovariance::own && reading.covariance.has_value();
    const Rigid movement = to_rigid(reading.movement);
    move(movement,
         is_own ? in_tangent(reading.movement, *reading.covariance)
                : covariance_of(movement, reading.is_planar));
    current_.planar_attitude = attitude_of(reading.is_planar);
    return true;
}

void DeadReckoning::forget(std::size_t count)
{
    readings_.erase(readings_.begin(), readings_.begin() + static_cast<std::ptrdiff_t>(count));
}

bool DeadReckoning::place(double seconds)
{
    const bool is_last = !readings_.empty() && clock_.last() == seconds;
    if (!readings_.empty() &&
        is_too_fast(readings_.back().at.map_from_robot, current_.map_from_robot, seconds))
    {
        current_ = readings_.back().at;
        ++current_.segment;
    }
    if (is_last)
        readings_.back().at = current_;  // several actions before one time stamp
    else if (clock_.accept(seconds))
        readings_.push_back({seconds, current_});
    else
        return false;
    return true;
}

}  // namespace fild
