// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace fild
{
/** The two nearest of the codes that a code was compared with. */
struct NearestTwo
{
    static constexpr int kNone = std::numeric_limits<int>::max();

    int bits = kNone;  ///< Hamming distance
    int second_bits = kNone;
    std::size_t index = 0;  ///< of equally near ones the lowest

    void compare(std::size_t i, int distance_bits)
    {
        if (distance_bits > second_bits) return;
        if (distance_bits < bits || (distance_bits == bits && i < index))
        {
            second_bits = bits;
            bits = distance_bits;
            index = i;
        }
        else
            second_bits = distance_bits;
    }
};

/** Sets `distances` to the Hamming distances, bits, of the code from all others. */
void hamming_distances(const std::uint64_t* code,
                       const BinaryCodes& others,
                       std::vector<int>& distances);

/** Finds the nearest of many codes. Compares eight at a time where the processor can count bits so
 *  (AVX-512 VPOPCNTDQ), with the same result. Const members may run concurrently. */
class NearestCodes
{
 public:
    /** \param codes  must outlive this. */
    explicit NearestCodes(const BinaryCodes& codes);
    /** \param eight_at_a_time  false: one after the other on any processor. */
    NearestCodes(const BinaryCodes& codes, bool eight_at_a_time);

    NearestTwo nearest_of(const std::uint64_t* code) const;

    static bool can_compare_eight();  ///< This processor can.

 private:
    const BinaryCodes& codes_;
    std::size_t words_;  ///< of a code
    std::vector<std::uint64_t> blocks_;  ///< first words of eight codes, their second words...
};

}  // namespace fild
