// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/paired_observations.h"

#include <mrpt/obs/CObservation.h>

#include <utility>

namespace fild
{
bool PairedObservations::feed(const mrpt::obs::CObservation& observation)
{
    for (auto& each : pairing_.feed(observation)) ready_.push_back(std::move(each));
    return pairing_.takes(observation);
}

void PairedObservations::finish()
{
    for (auto& each : pairing_.finish()) ready_.push_back(std::move(each));
}

PairedObservations::Observation PairedObservations::take()
{
    if (ready_.empty()) return nullptr;
    auto first = std::move(ready_.front());
    ready_.pop_front();
    return first;
}

}  // namespace fild
