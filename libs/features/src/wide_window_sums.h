// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes.h"

#include <utility>

// The parts of window_sums.h, for kCount points at a time.
namespace fild
{
/** Coordinates of the integral image between two of its entries. */
template <int kCount>
struct WideBetween
{
    using Floats = typename Lanes<kCount>::Floats;
    using Ints = typename Lanes<kCount>::Ints;

    Ints index;
    Floats fraction;

    FILD_IN_LANES WideBetween(const Floats& position, int pixels)
        : index(__builtin_convertvector(position, Ints))
    {
        index = index < pixels - 1 ? index : Ints{} + (pixels - 1);
        fraction = position - __builtin_convertvector(index, Floats);
    }
};

/** Each lane's entry at its offset of the integral image, and the entry after it. */
template <int kCount>
struct WidePair
{
    using L = Lanes<kCount>;
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    using Sums = typename L::Sums;
    using Words = typename L::Words;

    Sums first;
    Sums second;

    FILD_IN_LANES WidePair(const std::uint32_t* sums, const Ints& offsets)
        : WidePair(sums,
                   offsets,
                   std::make_integer_sequence<int, kCount / 2>(),
                   std::make_integer_sequence<int, kCount>())
    {
    }

 private:
    /** Both entries are loaded as one word. The words of lanes 0, 1, 4, 5, 8... are in one vector,
         *  those of lanes 2, 3, 6, 7, 10... in the other: separating entries then moves none out of
         *  its 128 bits, which is quick. */
    template <int... kWord, int... kLane>
    FILD_IN_LANES WidePair(const std::uint32_t* sums,
                           const Ints& offsets,
                           std::integer_sequence<int, kWord...>,
                           std::integer_sequence<int, kLane...>)
    {
        std::uint32_t offset[kCount];
        L::store(offsets, offset);
        const Words a{word_at(sums + offset[lane_of_word(kWord)])...};
        const Words b{word_at(sums + offset[lane_of_word(kWord) + 2])...};
        const auto entries_a = reinterpret_cast<Floats>(a);
        const auto entries_b = reinterpret_cast<Floats>(b);
        first = reinterpret_cast<Sums>(
            __builtin_shufflevector(entries_a, entries_b, place_of_lane(kLane)...));
        second = reinterpret_cast<Sums>(
            __builtin_shufflevector(entries_a, entries_b, (place_of_lane(kLane) + 1)...));
    }

    FILD_IN_LANES static std::uint64_t word_at(const std::uint32_t* sums)
    {
        std::uint64_t word;
        std::memcpy(&word, sums, sizeof(word));
        return word;
    }
    static constexpr int lane_of_word(int word) { return word / 2 * 4 + word % 2; }
    static constexpr int place_of_lane(int lane)
    {
        const int in_four = lane % 4;
        return lane - in_four + 2 * (in_four % 2) + (in_four < 2 ? 0 : kCount);
    }
};

template <class Floats>
FILD_IN_LANES Floats interpolate_lanes(const Floats& a, const Floats& b, const Floats& fraction)
{
    return a + fraction * (b - a);
}

}  // namespace fild
