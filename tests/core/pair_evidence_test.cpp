// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/pair_evidence.h"

#include "fild/core/descriptors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
using fild::PairOdds;

TEST(PairOdds, WeighBothOtherExplanations)
{
    const PairOdds odds{2, 3};
    EXPECT_NEAR(odds.log_odds(), -std::log(std::exp(-2.0) + std::exp(-3.0)), 1e-12);
    EXPECT_NEAR((PairOdds{3, 2}.log_odds()), odds.log_odds(), 1e-12);
}

TEST(PairOdds, AreNoBetterThanAgainstTheLikelierExplanation)
{
    EXPECT_NEAR((PairOdds{-700, 800}.log_odds()), -700, 1e-9);
    EXPECT_NEAR((PairOdds{800, -700}.log_odds()), -700, 1e-9);
}

TEST(LogOdds, AndProbabilityAreInverse)
{
    EXPECT_DOUBLE_EQ(fild::probability_of(0), 0.5);
    for (const double p : {0.001, 0.3, 0.95, 0.9999})
        EXPECT_NEAR(fild::probability_of(fild::log_odds_of(p)), p, 1e-12);
    EXPECT_EQ(fild::probability_of(1000), 1);
    EXPECT_EQ(fild::probability_of(-1000), 0);
}

TEST(Evidence, HasAWordOfItsOwnForEachKind)
{
    std::set<std::string> words;
    for (std::size_t k = 0; k < fild::kEvidenceKinds; ++k)
        words.insert(to_word(static_cast<fild::Evidence>(k)));
    EXPECT_EQ(words.size(), fild::kEvidenceKinds);
    EXPECT_EQ(to_word(fild::Evidence::overlap_share), "overlap_share");
}

TEST(KeypointShape, KeepsSizeAndAngleToTheNearestStep)
{
    fild::Keypoint keypoint;
    keypoint.size = 16;
    keypoint.angle = 1.5707964F;
    EXPECT_EQ(shape_of(keypoint).size, 64);  // four octaves
    EXPECT_EQ(shape_of(keypoint).angle, 64);  // a quarter of a turn
    keypoint.size = 0.1F;
    keypoint.angle = 6.2831F;
    EXPECT_EQ(shape_of(keypoint).size, 0);
    EXPECT_EQ(shape_of(keypoint).angle, 0) << "a whole turn is none";
    keypoint.size = 1e9F;
    EXPECT_EQ(shape_of(keypoint).size, 255);
}

TEST(HammingDistance, CountsTheBitsThatDiffer)
{
    const std::uint64_t a[] = {0, 0xFFFF};
    const std::uint64_t b[] = {1, 0};
    EXPECT_EQ(fild::hamming_distance(a, b, 2), 17);
    EXPECT_EQ(fild::hamming_distance(a, b, 1), 1);
    EXPECT_EQ(fild::hamming_distance(a, a, 2), 0);
}

}  // namespace
