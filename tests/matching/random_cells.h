// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/random.h"
#include "fild/matching/cell_hasher.h"

#include <cstdint>
#include <random>

namespace fild::testing
{
inline constexpr int kRows = 6;
inline constexpr int kColumns = 8;
inline constexpr int kChannels = 16;

inline CellFeatures random_cells(std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    CellFeatures cells{kRows, kColumns, kChannels, {}};
    for (std::size_t i = 0; i < cells.size() * kChannels; ++i)
        cells.values.push_back(static_cast<float>(standard_normal(generator)));
    return cells;
}

inline CellCodes cell_codes(const CellFeatures& cells)
{
    return hash_cells(cells, 256, 1);
}

/** The cells moved to the right; what comes in from the left is new. */
inline CellFeatures moved(const CellFeatures& cells, int columns)
{
    auto result = random_cells(77);
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column + columns < kColumns; ++column)
            for (int c = 0; c < kChannels; ++c)
                result.values[((row * kColumns) + column + columns) * kChannels + c] =
                    cells.values[((row * kColumns) + column) * kChannels + c];
    return result;
}
}  // namespace fild::testing
