// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/code_matcher.h"

#include "code_distance.h"
#include "fild/matching/code_hasher.h"
#include "random_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace
{
using fild::BinaryCodes;
using fild::Match;
using fild::testing::code_distance;
using fild::testing::random_features;
using fild::testing::with_noise;

fild::THashingOptions options_of(fild::CodeSearch search, double ratio = 0.7, bool mutual = false)
{
    fild::THashingOptions options;
    options.search = search;
    options.ratio = ratio;
    options.mutual_check = mutual;
    return options;
}

const auto kExhaustive = fild::CodeSearch::exhaustive;
const auto kCascade = fild::CodeSearch::cascade;

/** Codes of one word each, of 64 bits. */
BinaryCodes codes_of(const std::vector<std::uint64_t>& words)
{
    BinaryCodes codes;
    codes.bits = 64;
    codes.words_per_code = 1;
    codes.words = words;
    return codes;
}

BinaryCodes hash(const fild::LocalFeatures& features, fild::CodeSearch search)
{
    const std::vector<float> zeros(fild::LocalFeatures::dimension, 0.0F);
    const std::vector<float> ones(fild::LocalFeatures::dimension, 1.0F);
    return fild::CodeHasher(options_of(search), {zeros, ones}, 1).hash(features, 1);
}

std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<Match>& matches)
{
    std::vector<std::pair<std::size_t, std::size_t>> result;
    result.reserve(matches.size());
    for (const auto& match : matches) result.emplace_back(match.query, match.candidate);
    return result;
}

TEST(CodeMatcher, AgreesWithBruteForce)
{
    const auto query = hash(random_features(150, 1), kExhaustive);
    const auto candidate = hash(with_noise(random_features(150, 1), 0.6, 2), kExhaustive);
    std::vector<std::pair<std::size_t, std::size_t>> expected;
    for (std::size_t q = 0; q < query.size(); ++q)
    {
        std::vector<std::pair<int, std::size_t>> all;
        for (std::size_t c = 0; c < candidate.size(); ++c)
            all.emplace_back(code_distance(query, q, candidate, c), c);
        std::sort(all.begin(), all.end());
        if (all[0].first <= 0.49 * all[1].first) expected.emplace_back(q, all[0].second);
    }
    ASSERT_GT(expected.size(), 50U);
    EXPECT_EQ(pairs(fild::CodeMatcher(options_of(kExhaustive)).match(query, candidate)), expected);
}

TEST(CodeMatcher, CascadeFindsNearlyAllOfTheExhaustiveMatches)
{
    const auto query = hash(random_features(500, 3), kCascade);
    const auto candidate = hash(with_noise(random_features(500, 3), 0.4, 4), kCascade);
    const auto all = pairs(fild::CodeMatcher(options_of(kExhaustive)).match(query, candidate));
    const auto found = pairs(fild::CodeMatcher(options_of(kCascade)).match(query, candidate));
    ASSERT_GT(all.size(), 400U);
    std::vector<std::pair<std::size_t, std::size_t>> both;
    std::set_intersection(
        all.begin(), all.end(), found.begin(), found.end(), std::back_inserter(both));
    EXPECT_GT(static_cast<double>(both.size()), 0.9 * static_cast<double>(all.size()));
}

TEST(CodeMatcher, MatchesNothingWithNoneOrOneCode)
{
    const fild::CodeMatcher matcher(options_of(kExhaustive));
    EXPECT_TRUE(matcher.match(codes_of({}), codes_of({})).empty());
    EXPECT_TRUE(matcher.match(codes_of({1, 2}), codes_of({})).empty());
    EXPECT_TRUE(matcher.match(codes_of({}), codes_of({1, 2})).empty());
    EXPECT_TRUE(matcher.match(codes_of({1}), codes_of({1})).empty());
}

TEST(CodeMatcher, RejectsAmbiguousDuplicates)
{
    const fild::CodeMatcher matcher(options_of(kExhaustive));
    EXPECT_TRUE(matcher.match(codes_of({5}), codes_of({5, 5, 5})).empty());
    EXPECT_TRUE(matcher.match(codes_of({5}), codes_of({4, 4})).empty());
}

TEST(CodeMatcher, CountsDistancesUpToAllBits)
{
    const fild::CodeMatcher matcher(options_of(kExhaustive, 1.0));
    const auto matches = matcher.match(codes_of({0}), codes_of({~0ULL, ~0ULL}));
    ASSERT_EQ(matches.size(), 1U);
    EXPECT_EQ(matches[0].distance_bits, 64);
    EXPECT_EQ(matches[0].candidate, 0U);
}

TEST(CodeMatcher, MutualCheckMakesMatchesOneToOne)
{
    const auto query = codes_of({0b0000, 0b0001});
    const auto candidate = codes_of({0b0000, 0xFFFFFFFF});
    EXPECT_EQ(fild::CodeMatcher(options_of(kExhaustive)).match(query, candidate).size(), 2U);
    const auto mutual =
        fild::CodeMatcher(options_of(kExhaustive, 0.7, true)).match(query, candidate);
    EXPECT_EQ(pairs(mutual), (std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}}));
}

TEST(CodeMatcher, RefusesCodesThatDoNotCompare)
{
    auto longer = codes_of({1, 2});
    longer.bits = 32;
    EXPECT_THROW(fild::CodeMatcher(options_of(kExhaustive)).match(codes_of({1}), longer),
                 std::invalid_argument);
    EXPECT_THROW(fild::CodeMatcher(options_of(kCascade)).match(codes_of({1}), codes_of({1})),
                 std::invalid_argument);
}

}  // namespace
