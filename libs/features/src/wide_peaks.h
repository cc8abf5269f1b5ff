// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes.h"
#include "row_peaks.h"

#include <algorithm>

namespace fild
{
/** append_row_peaks(), row_peaks.h, of kCount columns at a time. */
template <int kCount>
FILD_IN_LANES void append_row_peaks_in_lanes(const HessianLayer& layer,
                                             int row,
                                             ColumnRange range,
                                             float threshold,
                                             std::vector<int>& columns)
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    const float* rows[] = {layer.row(row - 1), layer.row(row), layer.row(row + 1)};
    int x = range.first;
    for (; x + kCount <= range.last; x += kCount)
    {
        const auto centre = L::template load<Floats>(rows[1] + x);
        Floats largest = centre;
        if (!L::any_set(centre > threshold ? Ints{} - 1 : Ints{})) continue;
        for (const float* near : rows)
            for (int dx = -1; dx <= 1; ++dx)
                largest = L::larger(largest, L::template load<Floats>(near + x + dx));
        const Ints above = centre > threshold ? Ints{} - 1 : Ints{};
        const Ints peaks = largest > centre ? Ints{} : above;
        if (!L::any_set(peaks)) continue;
        std::int32_t is_peak[kCount];
        L::store(peaks, is_peak);
        for (int lane = 0; lane < kCount; ++lane)
            if (is_peak[lane] != 0) columns.push_back(x + lane);
    }
    append_row_peaks(layer, row, {x, range.last}, threshold, columns);
}

}  // namespace fild
