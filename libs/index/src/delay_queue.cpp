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
    if (!entries_.empty() && entry.time < entries_.back().time)
        throw std::invalid_argument("DelayQueue: time goes backwards");
    entries_.push_back(std::move(entry));
    std::vector<Entry> released;
    while (entries_.size() > 1 && has_waited(entries_.front()))
    {
        released.push_back(std::move(entries_.front()));
        entries_.pop_front();
    }
    return released;
}

bool DelayQueue::has_waited(const Entry& oldest) const
{
    if (delay_frames_ > 0) return static_cast<double>(entries_.size() - 1) >= delay_frames_;
    return entries_.back().time - oldest.time >= delay_seconds_;
}

}  // namespace fild
