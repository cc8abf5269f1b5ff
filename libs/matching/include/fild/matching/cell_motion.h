// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** How far a cell of one image stands from itself in another, in cells. */
struct CellShift
{
    int rows = 0;
    int columns = 0;
};

/** Where the cells of a query stand in a candidate. Value type. */
struct CellMotion
{
    int rows = 0;
    int columns = 0;
    /** Row by row; empty for a cell that does not agree with those about it. */
    std::vector<std::optional<CellShift>> shifts;

    std::size_t agreeing() const;  ///< How many cells have a shift.
};

/** A cell of the query is matched when its nearest cell of the candidate has it as nearest, too; it
 *  agrees when two or more of the eight cells about it are matched and have moved as it has, to
 *  within one row and one column. Chance leaves few: what is alike stands in another order. Costs
 *  cells x cells code comparisons. Deterministic: among equal distances the lower index wins.
 *  \return an empty motion when either image has no cells.
 *  \throw std::invalid_argument when the codes differ in length. */
CellMotion cell_motion(const CellCodes& query, const CellCodes& candidate);

}  // namespace fild
