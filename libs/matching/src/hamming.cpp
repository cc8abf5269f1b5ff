// SPDX-License-Identifier: BSD-3-Clause
#include "hamming.h"

namespace fild
{
__attribute__((target_clones("default", "popcnt"))) void hamming_distances(
    const std::uint64_t* code,
    const std::uint64_t* others,
    std::size_t words,
    std::size_t count,
    int* distances)
{
    for (std::size_t i = 0; i < count; ++i, others += words)
    {
        int bits = 0;
        for (std::size_t w = 0; w < words; ++w) bits += __builtin_popcountll(code[w] ^ others[w]);
        distances[i] = bits;
    }
}

}  // namespace fild
