// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/stage_times.h"

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
/** Nearest-rank quantile of ascending values. */
double quantile(const std::vector<float>& ascending, double share)
{
    const auto rank = std::ceil(share * static_cast<double>(ascending.size()));
    return ascending[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}
}  // namespace

void StageTimes::add(const std::string& stage, double milliseconds)
{
    auto& calls = calls_[stage];
    calls.milliseconds.push_back(static_cast<float>(milliseconds));
    calls.total_ms += milliseconds;
}

void StageTimes::merge(const StageTimes& other)
{
    for (const auto& [stage, calls] : other.calls_)
    {
        auto& ours = calls_[stage];
        ours.milliseconds.insert(
            ours.milliseconds.end(), calls.milliseconds.begin(), calls.milliseconds.end());
        ours.total_ms += calls.total_ms;
    }
}

double StageTimes::total_ms(const std::string& stage) const
{
    const auto calls = calls_.find(stage);
    return calls == calls_.end() ? 0 : calls->second.total_ms;
}

std::map<std::string, StageTimes::Statistics> StageTimes::statistics() const
{
    std::map<std::string, Statistics> result;
    for (const auto& [stage, calls] : calls_)
    {
        auto ascending = calls.milliseconds;
        std::sort(ascending.begin(), ascending.end());
        Statistics& statistics = result[stage];
        statistics.calls = ascending.size();
        statistics.total_ms = calls.total_ms;
        statistics.mean_ms = statistics.total_ms / static_cast<double>(ascending.size());
        statistics.median_ms = quantile(ascending, 0.5);
        statistics.p95_ms = quantile(ascending, 0.95);
        statistics.max_ms = ascending.back();
    }
    return result;
}

}  // namespace fild
