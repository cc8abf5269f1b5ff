// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/rawlog/motion_readings.h"
#include "timed_readings.h"

#include <optional>
#include <vector>

namespace fild
{
/** What a robot drove outside of gaps. */
struct Driven
{
    double seconds = 0;
    double way = 0;  ///< metres
    double turn = 0;  ///< radians, left and right alike

    void add(const Rigid& movement, double elapsed);
};

/** Sums up the readings of one odometry; the map begins at the first of them.
 *
 *  An odometry that is reset, or jumps further than a robot can move, begins a new segment at the
 *  last pose; so do actions that lead further. Not thread-safe: one caller at a time. */
class DeadReckoning
{
 public:
    explicit DeadReckoning(const TGraphOptions& options)
        : options_(options), clock_(options.max_gap_s)
    {
    }

    void add_pose(double seconds, const PoseReading& reading);

    /** From the pose before; place() says when its end was reached. \return false when it is not
     *  finite. */
    bool add_movement(const MovementReading& reading);

    /** The pose that movements led to was reached now. \return false when the time stamp is late.
     *  */
    bool place(double seconds);

    void count_unusable() { ++unusable_; }

    /** Readings that no frame needs any more, the oldest of those in memory. */
    void forget(std::size_t count);

    /** Those in memory. */
    const std::vector<TimedReading>& readings() const { return readings_; }
    KeptReadings kept() const
    {
        return {readings_, clock_.runs(), clock_.accepted() - readings_.size()};
    }
    const ReadingClock& clock() const { return clock_; }
    std::size_t resets() const { return static_cast<std::size_t>(current_.segment); }
    std::size_t unusable() const { return unusable_; }

 private:
    std::optional<Rigid> hidden_movement(double seconds) const;
    Matrix6 covariance_of(const Rigid& movement, bool is_planar) const;
    double attitude_of(bool is_planar) const;
    bool is_too_fast(const Rigid& before, const Rigid& now, double seconds) const;
    bool is_reset(const Rigid& before, const Rigid& now, double seconds) const;
    void move(const Rigid& movement, const Matrix6& covariance);

    TGraphOptions options_;
    ReadingClock clock_;
    std::vector<TimedReading> readings_;
    std::optional<Rigid> last_raw_;  ///< as the sensor reported it
    Driven driven_;
    UncertainPose current_;
    std::size_t unusable_ = 0;
};

}  // namespace fild
