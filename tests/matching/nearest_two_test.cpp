// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_two.h"

#include "code_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
/** Random codes, each bit set with probability 1/8, so that equal distances are frequent. */
fild::BinaryCodes random_codes(std::size_t count, int words, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    fild::BinaryCodes codes;
    codes.bits = 64 * words;
    codes.words_per_code = words;
    for (std::size_t i = 0; i < count * static_cast<std::size_t>(words); ++i)
        codes.words.push_back(generator() & generator() & generator());
    return codes;
}

fild::NearestTwo by_sorting(const std::uint64_t* code, const fild::BinaryCodes& others)
{
    std::vector<std::pair<int, std::size_t>> distances;
    for (std::size_t i = 0; i < others.size(); ++i)
        distances.emplace_back(
            fild::testing::code_distance(code, others.code(i), others.words_per_code), i);
    std::sort(distances.begin(), distances.end());
    fild::NearestTwo nearest;
    if (!distances.empty()) nearest.bits = distances[0].first;
    if (!distances.empty()) nearest.index = distances[0].second;
    if (distances.size() > 1) nearest.second_bits = distances[1].first;
    return nearest;
}

class NearestCodes : public ::testing::TestWithParam<bool>
{
};

TEST_P(NearestCodes, AreThoseThatSortingFinds)
{
    if (GetParam() && !fild::NearestCodes::can_compare_eight())
        GTEST_SKIP() << "this processor has no AVX-512 VPOPCNTDQ";
    for (const int words : {1, 2, 3, 4, 7})
        for (const std::size_t count : {0U, 1U, 2U, 7U, 8U, 9U, 16U, 100U, 1001U})
        {
            const auto codes = random_codes(count, words, 1);
            const auto queries = random_codes(20, words, 2);
            const fild::NearestCodes nearest_codes(codes, GetParam());
            for (std::size_t q = 0; q < queries.size(); ++q)
            {
                const auto found = nearest_codes.nearest_of(queries.code(q));
                const auto expected = by_sorting(queries.code(q), codes);
                ASSERT_EQ(found.bits, expected.bits) << words << " words, " << count << " codes";
                ASSERT_EQ(found.second_bits, expected.second_bits);
                ASSERT_EQ(found.index, expected.index);
            }
        }
}

TEST_P(NearestCodes, MayDifferInAllBits)
{
    if (GetParam() && !fild::NearestCodes::can_compare_eight())
        GTEST_SKIP() << "this processor has no AVX-512 VPOPCNTDQ";
    fild::BinaryCodes codes;
    codes.bits = 256;
    codes.words_per_code = 4;
    codes.words.assign(4, ~0ULL);
    const std::vector<std::uint64_t> zero(4, 0);
    const auto nearest = fild::NearestCodes(codes, GetParam()).nearest_of(zero.data());
    EXPECT_EQ(nearest.bits, 256);
    EXPECT_EQ(nearest.second_bits, fild::NearestTwo::kNone);
}

INSTANTIATE_TEST_SUITE_P(OneByOneAndEightAtATime, NearestCodes, ::testing::Bool());

}  // namespace
