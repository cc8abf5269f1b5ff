// SPDX-License-Identifier: BSD-3-Clause
#include "hamming.h"

namespace fild
{
namespace
{
/** The loop for a number of words known to the compiler, which then unrolls it; 0: not known. */
template <std::size_t kWords>
[[gnu::always_inline]] inline void distances_of(const std::uint64_t* code,
                                                const std::uint64_t* others,
                                                std::size_t words,
                                                std::size_t count,
                                                int* distances)
{
    const std::size_t length = kWords == 0 ? words : kWords;
    for (std::size_t i = 0; i < count; ++i, others += length)
    {
        int bits = 0;
        for (std::size_t w = 0; w < length; ++w) bits += __builtin_popcountll(code[w] ^ others[w]);
        distances[i] = bits;
    }
}
}  // namespace

__attribute__((target_clones("default", "popcnt"))) void hamming_distances(
    const std::uint64_t* code,
    const std::uint64_t* others,
    std::size_t words,
    std::size_t count,
    int* distances)
{
    if (words == 4)  // 256 bits, what nearly everybody uses
        distances_of<4>(code, others, words, count, distances);
    else
        distances_of<0>(code, others, words, count, distances);
}

}  // namespace fild
