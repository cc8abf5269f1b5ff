// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/code_hasher.h"

#include "code_distance.h"
#include "random_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{
using fild::testing::code_distance;
using fild::testing::random_features;
using fild::testing::with_noise;

const std::vector<float> kZeros(fild::LocalFeatures::dimension, 0.0F);
const std::vector<float> kOnes(fild::LocalFeatures::dimension, 1.0F);

fild::CodeHasher hasher(int bits,
                        std::uint64_t seed = 1,
                        fild::CodeSearch search = fild::CodeSearch::exhaustive)
{
    fild::THashingOptions options;
    options.bits = bits;
    options.search = search;
    return {options, {kZeros, kOnes}, seed};
}

int differing_bits(const fild::BinaryCodes& a, const fild::BinaryCodes& b)
{
    int bits = 0;
    for (std::size_t i = 0; i < a.size(); ++i) bits += code_distance(a, i, b, i);
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
        near += code_distance(a, i, b, i);
        far += code_distance(a, i, b, (i + 1) % a.size());
    }
    const double expected_near = 256 * std::atan(0.5) / 3.14159265;
    EXPECT_NEAR(near / 400, expected_near, 3);
    EXPECT_NEAR(far / 400, 128, 3);
}

TEST(CodeHasher, SubtractsTheMean)
{
    auto shifted = random_features(200, 4);
    std::vector<float> centre(fild::LocalFeatures::dimension, 0.0F);
    for (std::size_t k = 0; k < centre.size(); ++k) centre[k] = k % 2 == 0 ? 0.5F : 0.0F;
    for (std::size_t i = 0; i < shifted.descriptors.size(); ++i)
        shifted.descriptors[i] += centre[i % centre.size()];
    const fild::THashingOptions options;
    const auto plain = hasher(256).hash(random_features(200, 4), 1);
    const auto centred = fild::CodeHasher(options, {centre, kOnes}, 1).hash(shifted, 1);
    EXPECT_LT(differing_bits(plain, centred), 5);  // rounding alone
}

TEST(CodeHasher, DividesByTheDeviation)
{
    auto stretched = random_features(200, 4);
    auto deviation = kOnes;
    for (std::size_t k = 0; k < deviation.size(); k += 2) deviation[k] = 4;
    for (std::size_t i = 0; i < stretched.descriptors.size(); ++i)
        stretched.descriptors[i] *= deviation[i % deviation.size()];
    const fild::THashingOptions options;
    const auto plain = hasher(256).hash(random_features(200, 4), 1);
    const auto divided = fild::CodeHasher(options, {kZeros, deviation}, 1).hash(stretched, 1);
    EXPECT_LT(differing_bits(plain, divided), 5);
}

// One number far larger than all others decides most bits, unless the roots are hashed.
TEST(CodeHasher, RootedCodesListenToSmallNumbers)
{
    auto features = random_features(200, 4);
    for (std::size_t i = 0; i < features.size(); ++i)
        features.descriptors[i * fild::LocalFeatures::dimension] = 8;
    auto negated = features;
    for (auto& number : negated.descriptors)
        if (number < 8) number = -number;
    fild::THashingOptions options;
    const auto differing = [&]
    {
        const fild::CodeHasher hasher(options, {kZeros, kOnes}, 1);
        return differing_bits(hasher.hash(features, 1), hasher.hash(negated, 1));
    };
    const int plain = differing();
    options.rooted = true;
    EXPECT_GT(differing(), 2 * plain);
}

TEST(CodeHasher, RootsTheDescriptors)
{
    const auto features = random_features(200, 4);
    auto roots = features;
    for (auto& number : roots.descriptors)
        number = std::copysign(std::sqrt(std::abs(number)), number);
    fild::THashingOptions options;
    options.rooted = true;
    const auto rooted = fild::CodeHasher(options, {kZeros, kOnes}, 1).hash(features, 1);
    EXPECT_LT(differing_bits(hasher(256).hash(roots, 1), rooted), 5);
}

TEST(CodeHasher, RootsAnEmptyDescriptor)
{
    fild::LocalFeatures features;
    features.keypoints.resize(1);
    features.descriptors = kZeros;
    fild::THashingOptions options;
    options.rooted = true;
    const auto codes = fild::CodeHasher(options, {kZeros, kOnes}, 1).hash(features, 1);
    EXPECT_EQ(codes.words, std::vector<std::uint64_t>(4, 0));
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

TEST(CodeHasher, RefusesStatisticsOfAnotherLength)
{
    const std::vector<float> half(64, 1.0F);
    const fild::THashingOptions options;
    EXPECT_THROW(fild::CodeHasher(options, {half, kOnes}, 1), std::invalid_argument);
    EXPECT_THROW(fild::CodeHasher(options, {kZeros, half}, 1), std::invalid_argument);
}

}  // namespace
