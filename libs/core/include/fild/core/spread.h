// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace fild
{
/** `count` of the indices below `size`, or all when they are fewer: ascending, at even distances,
 *  the first and the last among them; a single one is in the middle. */
std::vector<std::size_t> spread_indices(std::size_t count, std::size_t size);

}  // namespace fild
