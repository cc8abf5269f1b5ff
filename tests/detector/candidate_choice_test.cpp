// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/candidate_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{
using fild::BelievableCandidate;
using fild::ConsideredCandidate;
using fild::FrameId;
using fild::PlaceStates;

ConsideredCandidate candidate(std::uint64_t frame, double log_odds, std::size_t inliers = 0)
{
    ConsideredCandidate entry;
    entry.inliers = inliers;
    entry.candidate.frame = FrameId{frame};
    entry.odds = {log_odds, log_odds};
    return entry;
}

/** 100 places, the camera at one of two. */
PlaceStates at(std::size_t place, double probability, std::size_t other, double of_other)
{
    PlaceStates states{0, std::vector<double>(100, 0), std::vector<double>(100, 0)};
    states.same[place] = probability;
    states.same[other] = of_other;
    return states;
}

TEST(CandidateChoice, PrefersTheMoreProbableThenThatWithMoreInliers)
{
    constexpr double kEnough = -2;
    EXPECT_TRUE(is_better(candidate(1, -3, 5), candidate(2, -4, 9), kEnough));
    EXPECT_TRUE(is_better(candidate(1, -1, 5), candidate(2, -4, 9), kEnough));
    EXPECT_TRUE(is_better(candidate(1, -1, 50), candidate(2, 4, 30), kEnough));
    EXPECT_FALSE(is_better(candidate(1, -1, 30), candidate(2, -1, 30), kEnough));
    EXPECT_TRUE(is_better(candidate(1, -9, 0), ConsideredCandidate{}, kEnough)) << "without odds";
}

TEST(CandidateChoice, NamesTheCandidateWithMostInliersAtTheMostProbablePlace)
{
    const auto far = candidate(80, 9, 200);
    const auto fair = candidate(10, 5, 20);
    const auto good = candidate(12, 2, 50);
    const std::vector<BelievableCandidate> candidates{{&far, 80}, {&fair, 10}, {&good, 12}};
    EXPECT_EQ(most_probable(candidates, at(10, 0.9, 80, 0.1)).candidate.frame, FrameId{12});
    EXPECT_EQ(most_probable(candidates, at(10, 0.1, 80, 0.9)).candidate.frame, FrameId{80});
    EXPECT_EQ(most_probable({{&fair, 10}}, at(80, 0.9, 81, 0.1)).candidate.frame, FrameId{10});
}

TEST(CandidateChoice, CountsOnlyPlacesNearACandidateOfTheFrame)
{
    const auto first_lap = candidate(10, 5);
    const auto second_lap = candidate(60, 5);
    const auto states = at(12, 0.5, 63, 0.4);
    EXPECT_DOUBLE_EQ(probability_near({{&first_lap, 10}}, states), 0.5);
    EXPECT_DOUBLE_EQ(probability_near({{&first_lap, 10}, {&second_lap, 60}}, states), 0.9);
    EXPECT_DOUBLE_EQ(probability_near({{&first_lap, 10}, {&first_lap, 10}}, at(15, 0.5, 16, 0.4)),
                     0.5);
}

}  // namespace
