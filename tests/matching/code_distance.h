// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <bitset>
#include <cstddef>

namespace fild::testing
{
/** Bits that differ between two codes, counted in the plainest way. */
inline int code_distance(const BinaryCodes& a, std::size_t i, const BinaryCodes& b, std::size_t j)
{
    int bits = 0;
    for (int w = 0; w < a.words_per_code; ++w)
        bits += static_cast<int>(std::bitset<64>(a.code(i)[w] ^ b.code(j)[w]).count());
    return bits;
}
}  // namespace fild::testing
