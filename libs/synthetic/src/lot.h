// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace fild
{
/** Decisions drawn by lot; the same seed draws the same with every standard library. Not
 *  thread-safe. */
class Lot
{
 public:
    explicit Lot(std::uint64_t seed) : generator_(seed) {}

    /** In [low, high). */
    double real(double low, double high)
    {
        return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1.0p-53;
    }
    /** In [low, high], both included. */
    int whole(int low, int high)
    {
        const auto count = static_cast<std::uint64_t>(high - low) + 1;
        return low + static_cast<int>(generator_() % count);
    }
    bool chance(double probability) { return real(0, 1) < probability; }
    std::uint64_t seed() { return generator_(); }

    template <class T>
    const T& pick(const std::vector<T>& choices)
    {
        return choices[static_cast<std::size_t>(whole(0, static_cast<int>(choices.size()) - 1))];
    }

 private:
    std::mt19937_64 generator_;
};

}  // namespace fild
