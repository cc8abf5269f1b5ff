// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <cstdint>

namespace fild
{
/** Turns what the network sees in each cell into binary codes by random projections, as CodeHasher
 *  does with local descriptors: bit s of a cell x is 1 when p_s . x > 0.
 *  \param bits  of a code, a multiple of 32.
 *  \param seed  of the projections: the same seed gives the same codes everywhere. */
CellCodes hash_cells(const CellFeatures& cells, int bits, std::uint64_t seed);

}  // namespace fild
