// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <cstddef>

namespace fild
{
/** How many cells of the query agree on where they are in the candidate. A cell is matched when its
 *  nearest cell of the candidate has it as nearest, too; it agrees when two or more of the eight cells
 *  about it are matched and have moved as it has, to within one row and one column. Chance leaves few:
 *  what is alike stands in another order.
 *  Costs cells x cells code comparisons. Deterministic: among equal distances the lower index wins.
 *  \return 0 when either has no cells.
 *  \throw std::invalid_argument when the codes differ in length. */
std::size_t agreeing_cells(const CellCodes& query, const CellCodes& candidate);

}  // namespace fild
