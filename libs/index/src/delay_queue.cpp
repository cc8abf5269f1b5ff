// SPDX-License-Identifier: BSD-3-Clause
// The delay queue of FILD (An et al., IROS 2019), section III-B.3.
#include "fild/index/delay_queue.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace fild
{
DelayQueue::DelayQueue(const TIndexOptions& options)
    : delay_seconds_(options.delay_seconds),
      delay_frames_(std::ceil(options.delay_seconds * options.frame_rate))
{
}

std::vector<DelayQueue::Entry> DelayQueue::push(Entry entry)
{
    if (!entries_.empty() && entry.time < entries_.back().entry.time)
        throw std::invalid_argument("DelayQueue: time goes backwards");
    const auto instant = instants_.add(entry.camera);
    entries_.push_back({std::move(entry), instant});
    std::vector<Entry> released;
    while (entries_.size() > 1 && has_waited(entries_.front()))
    {
        released.push_back(std::move(entries_.front().entry));
        entries_.pop_front();
    }
    return released;
}

bool DelayQueue::has_waited(const Waiting& oldest) const
{
    const auto& newest = entries_.back();
    if (delay_frames_ > 0)
        return static_cast<double>(newest.instant - oldest.instant) >= delay_frames_;
    return newest.entry.time - oldest.entry.time >= delay_seconds_;
}

}  // namespace fild
