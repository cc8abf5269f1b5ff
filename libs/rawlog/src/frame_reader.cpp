// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/frame_reader.h"

#include <mrpt/obs/CObservation.h>

namespace fild
{
FrameReader::FrameReader(const std::string& rawlog, const TInputOptions& options)
    : rawlog_(rawlog, options), builder_(options, rawlog)
{
}

bool FrameReader::next()
{
    const bool is_first = observation_ == nullptr;
    if (!is_first && builder_.next_id() == id_) builder_.skip(*observation_);
    do observation_ = rawlog_.next();
    while (observation_ && !builder_.accepts(*observation_));
    id_ = builder_.next_id();
    return observation_ != nullptr;
}

Frame FrameReader::build()
{
    return builder_.build(*observation_);
}

Frame FrameReader::skip()
{
    return builder_.skip(*observation_);
}

}  // namespace fild
