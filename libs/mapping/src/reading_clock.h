// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** Readings [begin, end) whose times grow. */
struct ClockRun
{
    std::size_t begin = 0;
    std::size_t end = 0;
};

/** The time stamps of one sensor, in the order of the recording. */
class ReadingClock
{
 public:
    explicit ReadingClock(double max_gap_s) : max_gap_s_(max_gap_s) {}

    /** \return false for a reading that comes late: up to a second older than the one before, or as
     *          old. Further back is a clock that was set: a new run begins. */
    bool accept(double seconds);

    const std::optional<double>& last() const { return last_; }
    const std::vector<ClockRun>& runs() const { return runs_; }
    std::size_t accepted() const { return runs_.empty() ? 0 : runs_.back().end; }
    std::size_t late() const { return late_; }
    std::size_t gaps() const { return gaps_; }
    std::size_t jumps() const { return runs_.empty() ? 0 : runs_.size() - 1; }

 private:
    double max_gap_s_;
    std::vector<ClockRun> runs_;
    std::optional<double> last_;
    std::size_t late_ = 0;
    std::size_t gaps_ = 0;
};

}  // namespace fild
