// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/cell_hasher.h"

#include "fild/core/random.h"

#include <algorithm>
#include <random>
#include <vector>

namespace fild
{
namespace
{
constexpr std::size_t kWordBits = 64;

/** Independent normal numbers, `bits` for one channel after the other. */
std::vector<float> random_projections(std::size_t channels, std::size_t bits, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    std::vector<float> projections(channels * bits);
    std::generate(projections.begin(),
                  projections.end(),
                  [&] { return static_cast<float>(standard_normal(generator)); });
    return projections;
}

void add_scaled(float factor, const float* row, std::vector<float>& sums)
{
    for (std::size_t s = 0; s < sums.size(); ++s) sums[s] += factor * row[s];
}
}  // namespace

CellCodes hash_cells(const CellFeatures& cells, int bits, std::uint64_t seed)
{
    const auto channels = static_cast<std::size_t>(cells.channels);
    const auto length = static_cast<std::size_t>(bits);
    const auto words = (length + kWordBits - 1) / kWordBits;
    CellCodes hashed{cells.rows, cells.columns, {}};
    auto& codes = hashed.codes;
    codes.bits = bits;
    codes.words_per_code = static_cast<int>(words);
    codes.words.resize(cells.size() * words);
    const auto projections = random_projections(channels, length, seed);
    std::vector<float> sums(length);
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        std::fill(sums.begin(), sums.end(), 0.0F);
        for (std::size_t c = 0; c < channels; ++c)
            add_scaled(cells.values[i * channels + c], projections.data() + c * length, sums);
        auto* word = codes.words.data() + i * words;
        for (std::size_t s = 0; s < length; ++s)
            word[s / kWordBits] |= std::uint64_t{sums[s] > 0} << (s % kWordBits);
    }
    return hashed;
}

}  // namespace fild
