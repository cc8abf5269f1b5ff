// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/spread.h"

#include <algorithm>

namespace fild
{
std::vector<std::size_t> spread_indices(std::size_t count, std::size_t size)
{
    count = std::min(count, size);
    if (count == 1) return {size / 2};
    std::vector<std::size_t> chosen(count);
    for (std::size_t i = 0; i < count; ++i) chosen[i] = i * (size - 1) / (count - 1);
    return chosen;
}

}  // namespace fild
