// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "box_hessian.h"

#include <vector>

namespace fild
{
/** Columns, half-open. */
struct ColumnRange
{
    int first = 0;
    int last = 0;
};

/** Appends the columns of the range whose determinant exceeds the threshold and is not below those
 *  of its eight neighbours in the layer, which must be there: what may be a maximum of the scale
 *  space. */
void append_row_peaks(const HessianLayer& layer,
                      int row,
                      ColumnRange range,
                      float threshold,
                      std::vector<int>& columns);

}  // namespace fild
