// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/rawlog/motion_readings.h"

#include <vector>

namespace fild
{
/** A GPS fix and when it was made. */
struct TimedFix
{
    double seconds = 0;
    GpsFix fix;
};

/** Heights are this many times as uncertain as horizontal positions, as is usual. */
constexpr double kVerticalOfHorizontal = 2;

/** Standard deviation of the horizontal position along each axis, metres: that of TGraphOptions for
 *  the fix's quality, times its dilution of precision. */
double horizontal_sigma(const GpsFix& fix, const TGraphOptions& options);

/** Which fixes a robot can have been at that is not faster than TGraphOptions::max_speed_m_per_s,
 *  give or take five standard deviations of each.
 *
 *  Each fix joins the track of fixes that it is reached from at the least speed, or begins one. The
 *  longest track counts, and with it those of at least five fixes that lie wholly before or after
 *  it: receivers move their fixes for good when their satellites change. So single fixes that are
 *  wrong are left out, wherever they come, and also when they agree with each other.
 *  \param fixes  in the order of the recording; over a clock that goes back the time between two is
 *  taken for TGraphOptions::max_gap_s. Costs time in proportion to their number. */
std::vector<bool> plausible_fixes(const std::vector<TimedFix>& fixes, const TGraphOptions& options);

}  // namespace fild
