// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** True when no robot that drives at most at that speed comes so far in that time. */
inline bool is_too_fast(double metres, double seconds, double max_speed_m_per_s)
{
    constexpr double kJitter = 1;  // m, where two time stamps are too close
    return metres > max_speed_m_per_s * seconds + kJitter;
}

}  // namespace fild
