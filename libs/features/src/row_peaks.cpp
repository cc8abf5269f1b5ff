// SPDX-License-Identifier: BSD-3-Clause
// First part of the search for maxima: SURF (CVIU 2008) section 3.4.
#include "row_peaks.h"

namespace fild
{
void append_row_peaks(const HessianLayer& layer,
                      int row,
                      ColumnRange range,
                      float threshold,
                      std::vector<int>& columns)
{
    const float* above = layer.row(row - 1);
    const float* here = layer.row(row);
    const float* below = layer.row(row + 1);
    for (int x = range.first; x < range.last; ++x)
    {
        const float centre = here[x];
        if (!(centre > threshold)) continue;
        if (here[x - 1] > centre || here[x + 1] > centre) continue;
        if (above[x - 1] > centre || above[x] > centre || above[x + 1] > centre) continue;
        if (below[x - 1] > centre || below[x] > centre || below[x + 1] > centre) continue;
        columns.push_back(x);
    }
}

}  // namespace fild
