// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace fild
{
/** Hamming distances, bits, of one code to `count` codes that stand one after the other, each of
 *  `words` words. Uses the processor's population count where it has one, with the same result. */
void hamming_distances(const std::uint64_t* code,
                       const std::uint64_t* others,
                       std::size_t words,
                       std::size_t count,
                       int* distances);

}  // namespace fild
