// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/recording_clock.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fild
{
namespace
{
constexpr double kLate = 1;  // s; stamps out of order by less are no jump
constexpr double kLasting = 1;  // s of stamps that go on: the clock was set
constexpr double kShortestJump = 5;  // s
constexpr double kJumpSteps = 10;
constexpr std::size_t kRecentSteps = 101;
}  // namespace

void RecordingClock::Steps::add(double step)
{
    steps_.push_back(step);
    if (steps_.size() > kRecentSteps) steps_.pop_front();
}

double RecordingClock::Steps::median() const
{
    if (steps_.empty()) return 0;
    std::vector<double> sorted(steps_.begin(), steps_.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

double RecordingClock::Steps::limit() const
{
    return std::max(kShortestJump, kJumpSteps * median());
}

double RecordingClock::advance(const std::string& camera, double stamp)
{
    if (!std::isfinite(stamp)) return now_;
    const auto [entry, is_new] = cameras_.try_emplace(camera);
    auto& state = entry->second;
    if (is_new)
    {
        state.newest = stamp;
        state.offset = now_ - stamp;
    }
    else if (fits(state, stamp))
        accept(state, stamp);
    else if (depart(state, stamp))
        set_clock(state);
    return now_;
}

bool RecordingClock::fits(const Camera& camera, double stamp) const
{
    return stamp >= camera.newest - kLate && stamp + camera.offset - now_ <= camera.steps.limit();
}

void RecordingClock::accept(Camera& camera, double stamp)
{
    camera.departure.reset();
    if (stamp <= camera.newest) return;
    camera.steps.add(stamp - camera.newest);
    camera.newest = stamp;
    now_ = std::max(now_, stamp + camera.offset);
}

bool RecordingClock::depart(Camera& camera, double stamp)
{
    auto& departure = camera.departure;
    const bool goes_on = departure && stamp >= departure->newest &&
                         stamp - departure->newest <= departure->steps.limit();
    if (!goes_on)
    {
        departure = Departure{stamp, stamp, now_, camera.steps};
        // A camera's first step may be its frame rate: the next one tells.
        if (!camera.steps.empty())
            ++jumps_;
        else if (stamp > camera.newest)
            departure->steps.add(stamp - camera.newest);
        return false;
    }
    if (stamp > departure->newest) departure->steps.add(stamp - departure->newest);
    departure->newest = stamp;
    return stamp - departure->first >= kLasting;
}

void RecordingClock::set_clock(Camera& camera)
{
    const auto departure = *camera.departure;
    const double step = departure.first - camera.newest;
    const bool was_no_jump = step > 0 && step <= departure.steps.limit();
    const double credit = was_no_jump ? step : departure.steps.median();
    const double begin = std::max(camera.newest + camera.offset + credit, departure.now);
    camera.offset = begin - departure.first;
    camera.newest = departure.newest;
    camera.steps = departure.steps;
    camera.departure.reset();
    now_ = std::max(now_, camera.newest + camera.offset);
}

}  // namespace fild
