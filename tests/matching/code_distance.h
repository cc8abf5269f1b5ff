// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace fild::testing
{
/** Bits that differ between two codes, counted in the plainest way. */
inline int code_distance(const std::uint64_t* a, const std::uint64_t* b, int words)
{
    int bits = 0;
    for (int w = 0; w < words; ++w) bits += static_cast<int>(std::bitset<64>(a[w] ^ b[w]).count());
    return bits;
}

inline int code_distance(const BinaryCodes& a, std::size_t i, const BinaryCodes& b, std::size_t j)
{
    return code_distance(a.code(i), b.code(j), a.words_per_code);
}
}  // namespace fild::testing
