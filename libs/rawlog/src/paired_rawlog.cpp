// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/paired_rawlog.h"

#include <mrpt/obs/CObservation.h>

#include <utility>

namespace fild
{
PairedRawlog::PairedRawlog(const std::string& path, const TInputOptions& options)
    : reader_(path, options.max_entry_megabytes), observations_(options)
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
    if (has_ended_)
        observations_.finish();
    else if (!observations_.feed(*observation))
        observations_.append(std::move(observation));
}

std::shared_ptr<mrpt::obs::CObservation> PairedRawlog::next()
{
    while (observations_.empty() && !has_ended_) read_on();
    if (observations_.empty() && damage_) std::rethrow_exception(damage_);
    return observations_.take();
}

}  // namespace fild
