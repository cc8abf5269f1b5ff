// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/paired_rawlog.h"

#include <mrpt/obs/CObservation.h>

namespace fild
{
PairedRawlog::PairedRawlog(const std::string& path, const TInputOptions& options)
    : reader_(path, options.max_entry_megabytes), pairing_(options)
{
}

void PairedRawlog::read_on()
{
    std::shared_ptr<mrpt::obs::CObservation> observation;
    try
    {
        observation = reader_.next();
    }
    catch (const TruncatedRawlog&)
    {
        damage_ = std::current_exception();
    }
    has_ended_ = !observation;
    for (auto& each : has_ended_ ? pairing_.finish() : pairing_.feed(*observation))
        ready_.push_back(std::move(each));
    if (observation && !pairing_.takes(*observation)) ready_.push_back(observation);
}

std::shared_ptr<mrpt::obs::CObservation> PairedRawlog::next()
{
    while (ready_.empty() && !has_ended_) read_on();
    if (ready_.empty() && damage_) std::rethrow_exception(damage_);
    if (ready_.empty()) return nullptr;
    auto next = ready_.front();
    ready_.pop_front();
    return next;
}

}  // namespace fild
