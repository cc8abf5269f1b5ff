// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/place_delay.h"

namespace fild
{
PlaceDelay::PlaceDelay(const TIndexOptions& options)
    : standstill_(options.still_seconds), queue_(options)
{
}

PlaceDelay::Arrival PlaceDelay::take(const FrameDescription& frame)
{
    now_ = clock_.advance(frame.sensor_label, frame.timestamp);
    const auto instant = instants_.add(frame.sensor_label);
    const auto stands_since = standstill_.add(frame.frame, frame.sensor_label, frame.local, now_);
    if (stands_since) return {instant, stands_since, {}};
    const double moving = standstill_.moving_seconds();
    return {instant,
            std::nullopt,
            queue_.push({frame.frame, moving, frame.global, frame.sensor_label})};
}

}  // namespace fild
