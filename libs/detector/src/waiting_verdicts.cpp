// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/waiting_verdicts.h"

#include <cmath>
#include <utility>

namespace fild
{
namespace
{
constexpr double kMaxFrameRate = 200;
}  // namespace

WaitingVerdicts::WaitingVerdicts(const TDetectorOptions& options)
    : seconds_(options.consistency.look_ahead_seconds), counts_frames_(options.index.frame_rate > 0)
{
    const double rate = counts_frames_ ? options.index.frame_rate : kMaxFrameRate;
    max_instants_ = static_cast<std::size_t>(std::ceil(seconds_ * rate));
}

void WaitingVerdicts::push(WaitingVerdict verdict, double now)
{
    const auto instant = instants_.add(verdict.outcome.verdict.sensor_label);
    frames_.push_back({std::move(verdict), now, instant});
}

bool WaitingVerdicts::oldest_is_due() const
{
    if (frames_.empty()) return false;
    const auto& oldest = frames_.front();
    const auto& newest = frames_.back();
    if (!oldest.verdict.may_change || newest.instant - oldest.instant >= max_instants_) return true;
    return !counts_frames_ && newest.time - oldest.time >= seconds_;
}

WaitingVerdict WaitingVerdicts::pop()
{
    auto verdict = std::move(frames_.front().verdict);
    frames_.pop_front();
    return verdict;
}

}  // namespace fild
