// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>

/** Compiles a function with the instructions that its caller is compiled for. */
#define FILD_IN_LANES [[gnu::always_inline]] inline

namespace fild
{
template <int kCount>
struct LaneTypes;

template <>
struct LaneTypes<4>
{
    using Floats [[gnu::vector_size(16)]] = float;
    using Ints [[gnu::vector_size(16)]] = std::int32_t;
    using Sums [[gnu::vector_size(16)]] = std::uint32_t;
    using Words [[gnu::vector_size(16)]] = std::uint64_t;
};

template <>
struct LaneTypes<8>
{
    using Floats [[gnu::vector_size(32)]] = float;
    using Ints [[gnu::vector_size(32)]] = std::int32_t;
    using Sums [[gnu::vector_size(32)]] = std::uint32_t;
    using Words [[gnu::vector_size(32)]] = std::uint64_t;
};

template <>
struct LaneTypes<16>
{
    using Floats [[gnu::vector_size(64)]] = float;
    using Ints [[gnu::vector_size(64)]] = std::int32_t;
    using Sums [[gnu::vector_size(64)]] = std::uint32_t;
    using Words [[gnu::vector_size(64)]] = std::uint64_t;
};

/** kCount numbers side by side, as GNU vectors: arithmetic on them is that of the numbers one by
 *  one, to the same bits. A comparison is best used in `?:` at once: GCC 12 takes masks of 16
 *  numbers that are stored or combined to pieces. */
template <int kCount>
struct Lanes
{
    using Floats = typename LaneTypes<kCount>::Floats;
    using Ints = typename LaneTypes<kCount>::Ints;
    using Sums = typename LaneTypes<kCount>::Sums;
    using Words = typename LaneTypes<kCount>::Words;

    template <class Vector, class Number>
    FILD_IN_LANES static Vector load(const Number* first)
    {
        Vector vector;
        std::memcpy(&vector, first, sizeof(vector));
        return vector;
    }
    template <class Vector, class Number>
    FILD_IN_LANES static void store(const Vector& vector, Number* first)
    {
        std::memcpy(first, &vector, sizeof(vector));
    }

    FILD_IN_LANES static Floats all(float number)
    {
        const Floats zero{};
        return number - zero;
    }
    /** Differences of sums, which may be negative. */
    FILD_IN_LANES static Floats to_floats(const Sums& sums)
    {
        return __builtin_convertvector(reinterpret_cast<Ints>(sums), Floats);
    }
    FILD_IN_LANES static Floats smaller(const Floats& a, const Floats& b) { return a < b ? a : b; }
    FILD_IN_LANES static Floats larger(const Floats& a, const Floats& b) { return a > b ? a : b; }
    FILD_IN_LANES static Floats magnitude(const Floats& numbers)
    {
        return reinterpret_cast<Floats>(reinterpret_cast<Ints>(numbers) & 0x7FFFFFFF);
    }
    FILD_IN_LANES static bool any_set(const Ints& bits)
    {
        std::uint64_t words[kCount / 2];
        store(bits, words);
        std::uint64_t all = 0;
        for (const auto word : words) all |= word;
        return all != 0;
    }
};

}  // namespace fild
