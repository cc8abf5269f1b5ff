// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/code_hasher.h"

#include "random_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <stdexcept>

namespace
{
using fild::testing::random_features;
using fild::testing::with_noise;

const std::vector<float> kNoCentre(fild::LocalFeatures::dimension, 0.0F);

fild::CodeHasher hasher(int bits,
                        std::uint64_t seed = 1,
                        fild::CodeSearch search = fild::CodeSearch::exhaustive)
{
    fild::THashingOptions options;
    options.bits = bits;
    options.search = search;
    return {options, kNoCentre, seed};
}

int distance(const fild::BinaryCodes& a, std::size_t i, const fild::BinaryCodes& b, std::size_t j)
{
    int bits = 0;
    for (int w = 0; w < a.words_per_code; ++w)
        bits += static_cast<int>(std::bitset<64>(a.code(i)[w] ^ b.code(j)[w]).count());
    return bits;
}

TEST(CodeHasher, MakesCodesOfTheLengthAsked)
{
    for (const int bits : {32, 64, 96, 128, 256})
    {
        const auto codes = hasher(bits).hash(random_features(5, 1), 1);
        EXPECT_EQ(codes.size(), 5U);
        EXPECT_EQ(codes.bits, bits);
        EXPECT_EQ(codes.words_per_code, (bits + 63) / 64);
        if (bits % 64 != 0)
        {
            EXPECT_EQ(codes.code(0)[codes.words_per_code - 1] >> 32U, 0U);
        }
    }
}

TEST(CodeHasher, MakesNoCodesOfNoFeatures)
{
    EXPECT_EQ(hasher(256).hash(fild::LocalFeatures(), 2).size(), 0U);
}

// P(bit differs) = angle / pi for random hyperplanes (Charikar, STOC 2002).
TEST(CodeHasher, HammingDistanceGrowsAsTheAngle)
{
    const auto features = random_features(400, 2);
    const auto noisy = with_noise(features, 0.5, 3);
    const auto make = hasher(256);
    const auto a = make.hash(features, 1);
    const auto b = make.hash(noisy, 1);
    double near = 0;
    double far = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        near += distance(a, i, b, i);
        far += distance(a, i, b, (i + 1) % a.size());
    }
    const double expected_near = 256 * std::atan(0.5) / 3.14159265;
    EXPECT_NEAR(near / 400, expected_near, 3);
    EXPECT_NEAR(far / 400, 128, 3);
}

TEST(CodeHasher, SubtractsTheCommonCentre)
{
    auto shifted = random_features(200, 4);
    std::vector<float> centre(fild::LocalFeatures::dimension, 0.0F);
    for (std::size_t k = 0; k < centre.size(); ++k) centre[k] = k % 2 == 0 ? 0.5F : 0.0F;
    for (std::size_t i = 0; i < shifted.descriptors.size(); ++i)
        shifted.descriptors[i] += centre[i % centre.size()];
    const fild::THashingOptions options;
    const auto plain = fild::CodeHasher(options, kNoCentre, 1).hash(random_features(200, 4), 1);
    const auto centred = fild::CodeHasher(options, centre, 1).hash(shifted, 1);
    int differing = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) differing += distance(plain, i, centred, i);
    EXPECT_LT(differing, 5);  // rounding alone
}

TEST(CodeHasher, RepeatsWithTheSeedAndWithAnyNumberOfThreads)
{
    const auto features = random_features(1000, 5);
    const auto cascade = fild::CodeSearch::cascade;
    const auto codes = hasher(256, 7, cascade).hash(features, 1);
    const auto again = hasher(256, 7, cascade).hash(features, 3);
    EXPECT_EQ(codes.words, again.words);
    EXPECT_EQ(codes.buckets, again.buckets);
    EXPECT_NE(codes.words, hasher(256, 8, cascade).hash(features, 1).words);
}

TEST(CodeHasher, FillsTheBucketsOfTheCoarseStep)
{
    const auto codes = hasher(64, 1, fild::CodeSearch::cascade).hash(random_features(2000, 6), 1);
    ASSERT_EQ(codes.buckets.size(), 2000U * 6);
    const auto [lowest, highest] = std::minmax_element(codes.buckets.begin(), codes.buckets.end());
    EXPECT_LT(*lowest, 8);
    EXPECT_GT(*highest, 247);
    EXPECT_LT(*highest, 256);
}

TEST(CodeHasher, RefusesACentreOfAnotherLength)
{
    EXPECT_THROW(fild::CodeHasher(fild::THashingOptions(), std::vector<float>(64), 1),
                 std::invalid_argument);
}

}  // namespace
