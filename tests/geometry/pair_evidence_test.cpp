// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/pair_evidence.h"

#include "fild/geometry/shape_agreement.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vector>

namespace
{
using fild::Evidence;
using fild::HashedFeatures;
using fild::Match;

constexpr std::size_t kKeypoints = 400;

/** Keypoints all over an image of 640x480, with codes of their own. */
HashedFeatures scattered(std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    HashedFeatures features;
    features.image_size = {640, 480};
    features.codes.bits = 256;
    features.codes.words_per_code = 4;
    for (std::size_t i = 0; i < kKeypoints; ++i)
    {
        features.positions.push_back({static_cast<float>(generator() % 6400) / 10,
                                      static_cast<float>(generator() % 4800) / 10});
        features.shapes.push_back({70, static_cast<std::uint8_t>(generator() & 0xFFU)});
        for (int w = 0; w < 4; ++w) features.codes.words.push_back(generator());
    }
    return features;
}

/** The same keypoints, moved to the right, turned and enlarged as a camera would see them. */
HashedFeatures moved(HashedFeatures features, float right, int turn_steps, int size_steps)
{
    for (auto& p : features.positions) p.x += right;
    for (auto& shape : features.shapes)
        shape = {static_cast<std::uint8_t>(shape.size + size_steps),
                 static_cast<std::uint8_t>(shape.angle + turn_steps)};
    return features;
}

std::vector<Match> first_matches(std::size_t count, int distance_bits)
{
    std::vector<Match> matches;
    for (std::size_t i = 0; i < count; ++i) matches.push_back({i, i, distance_bits});
    return matches;
}

double value(const fild::EvidenceValues& values, Evidence kind)
{
    return values[to_index(kind)];
}

TEST(DominantShape, IsTheRotationAndScaleOfMostMatches)
{
    const auto query = scattered(1);
    auto candidate = moved(query, 0, 40, 8);
    for (std::size_t i = 0; i < 10; ++i) candidate.shapes[i].angle += 100;
    const auto matches = first_matches(50, 30);
    const auto shape = fild::dominant_shape(matches, query.shapes, candidate.shapes, {});
    EXPECT_EQ(shape.angle_steps, 40);
    EXPECT_EQ(shape.size_steps, 8);
    EXPECT_EQ(shape.agreeing, 40U);
    const auto kept =
        fild::indices_of_shape(shape, matches, query.shapes, candidate.shapes, {30, 1});
    ASSERT_EQ(kept.size(), 40U);
    EXPECT_EQ(kept.front(), 10U);
    EXPECT_EQ(fild::dominant_shape({}, query.shapes, candidate.shapes, {}).agreeing, 0U);
}

TEST(DominantShape, KnowsThatATurnEndsWhereItBegins)
{
    auto query = scattered(1);
    auto candidate = query;
    query.shapes[0].angle = 2;
    candidate.shapes[0].angle = 254;
    query.shapes[1].angle = candidate.shapes[1].angle = 0;
    const auto shape =
        fild::dominant_shape(first_matches(2, 30), query.shapes, candidate.shapes, {});
    EXPECT_EQ(shape.agreeing, 2U) << "4 steps apart, not 252";
}

TEST(PairEvidence, OfAViewThatIsSeenAgainIsAllGood)
{
    const auto query = scattered(1);
    const auto candidate = moved(query, 5, 0, 0);
    const auto matches = first_matches(200, 60);
    const auto values = fild::measure_evidence({query, candidate, matches, matches, kKeypoints});
    EXPECT_NEAR(value(values, Evidence::inlier_share), 201.0 / 203, 1e-12);
    EXPECT_NEAR(value(values, Evidence::shape_share), 201.0 / 203, 1e-12);
    EXPECT_NEAR(value(values, Evidence::match_share), 201.0 / 403, 1e-12);
    EXPECT_NEAR(value(values, Evidence::close_share), 1.0 / 203, 1e-12) << "60 bits are not close";
    EXPECT_GT(value(values, Evidence::overlap_share), 0.8);
}

TEST(PairEvidence, CountsCloseMatchesThatAreNoInliers)
{
    const auto query = scattered(1);
    const auto candidate = moved(query, 5, 0, 0);
    const auto matches = first_matches(100, 10);
    const std::vector<Match> inliers(matches.begin(), matches.begin() + 25);
    const auto values = fild::measure_evidence({query, candidate, matches, inliers, kKeypoints});
    EXPECT_NEAR(value(values, Evidence::close_share), 101.0 / 103, 1e-12);
    EXPECT_NEAR(value(values, Evidence::inlier_share), 26.0 / 103, 1e-12);
}

TEST(PairEvidence, KnowsWhatIsBeyondTheBorder)
{
    const auto query = scattered(1);
    const auto candidate = moved(query, 320, 0, 0);  // half of the view is gone
    std::vector<Match> matches;
    for (std::size_t i = 0; i < kKeypoints; ++i)
        if (query.positions[i].x < 300) matches.push_back({i, i, 20});
    const auto inliers = matches;
    for (std::size_t i = 0; i < kKeypoints; ++i)
        if (query.positions[i].x > 400) matches.push_back({i, i, 20});
    const auto values = fild::measure_evidence({query, candidate, matches, inliers, kKeypoints});
    EXPECT_LT(value(values, Evidence::overlap_share), 0.6);
}

TEST(PairEvidence, TakesTooFewInliersForAWholeOverlap)
{
    const auto query = scattered(1);
    const auto matches = first_matches(20, 20);
    const std::vector<Match> inliers(matches.begin(), matches.begin() + 2);
    const auto values = fild::measure_evidence({query, query, matches, inliers, kKeypoints});
    EXPECT_NEAR(value(values, Evidence::overlap_share), 21.0 / 23, 1e-12);
}

TEST(PairEvidence, NeedsShapes)
{
    const auto query = scattered(1);
    auto without = query;
    without.shapes.clear();
    EXPECT_THROW(fild::measure_evidence({query, without, {}, {}, 0}), std::invalid_argument);
}

}  // namespace
