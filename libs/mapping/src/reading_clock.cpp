// SPDX-License-Identifier: BSD-3-Clause
#include "reading_clock.h"

namespace fild
{
bool ReadingClock::accept(double seconds)
{
    constexpr double kLate = 1;  // s
    if (last_ && seconds <= *last_ && seconds > *last_ - kLate)
    {
        ++late_;
        return false;
    }
    const auto index = accepted();
    const bool jumps = last_ && seconds < *last_;
    if (!jumps && last_ && seconds - *last_ > max_gap_s_) ++gaps_;
    if (jumps || runs_.empty()) runs_.push_back({index, index});
    runs_.back().end = index + 1;
    last_ = seconds;
    return true;
}

}  // namespace fild
