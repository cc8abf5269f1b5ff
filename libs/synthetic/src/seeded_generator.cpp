// SPDX-License-Identifier: BSD-3-Clause
#include "seeded_generator.h"

namespace fild
{
std::mt19937_64 seeded_generator(std::uint64_t seed, RandomPurpose purpose, std::uint64_t index)
{
    const auto low = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits); };
    const auto high = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits >> 32U); };
    std::seed_seq words{
        low(seed), high(seed), static_cast<std::uint32_t>(purpose), low(index), high(index)};
    return std::mt19937_64(words);
}

}  // namespace fild
