// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/stage_times.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
    milliseconds_[stage].push_back(static_cast<float>(milliseconds));
}

void StageTimes::merge(const StageTimes& other)
{
    for (const auto& [stage, calls] : other.milliseconds_)
    {
        auto& ours = milliseconds_[stage];
        ours.insert(ours.end(), calls.begin(), calls.end());
    }
}

std::map<std::string, StageTimes::Statistics> StageTimes::statistics() const
{
    std::map<std::string, Statistics> result;
    for (const auto& [stage, calls] : milliseconds_)
    {
        auto ascending = calls;
        std::sort(ascending.begin(), ascending.end());
        Statistics& statistics = result[stage];
        statistics.calls = ascending.size();
        statistics.total_ms = std::accumulate(ascending.begin(), ascending.end(), 0.0);
        statistics.mean_ms = statistics.total_ms / static_cast<double>(ascending.size());
        statistics.median_ms = quantile(ascending, 0.5);
        statistics.p95_ms = quantile(ascending, 0.95);
        statistics.max_ms = ascending.back();
    }
    return result;
}

}  // namespace fild
