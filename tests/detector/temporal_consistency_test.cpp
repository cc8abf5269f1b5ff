// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/temporal_consistency.h"

#include <gtest/gtest.h>

namespace
{
fild::TemporalConsistency consistency(int frames, double max_step = 0)
{
    fild::TConsistencyOptions options;
    options.consecutive_frames = frames;
    options.max_candidate_step_seconds = max_step;
    return fild::TemporalConsistency(options);
}

TEST(TemporalConsistency, AcceptsFromTheLastOfBetaFramesOn)
{
    auto check = consistency(3);
    EXPECT_FALSE(check.add_verified("A", 10));
    EXPECT_FALSE(check.add_verified("A", 11));
    EXPECT_TRUE(check.add_verified("A", 12));
    EXPECT_TRUE(check.add_verified("A", 13));
}

TEST(TemporalConsistency, StartsAgainAfterAnUnverifiedFrame)
{
    auto check = consistency(2);
    check.add_verified("A", 10);
    check.add_unverified("A");
    EXPECT_FALSE(check.add_verified("A", 11));
    EXPECT_TRUE(check.add_verified("A", 12));
}

TEST(TemporalConsistency, BetaOneAcceptsAtOnce)
{
    EXPECT_TRUE(consistency(1).add_verified("A", 0));
}

TEST(TemporalConsistency, TakesAnyCandidatesWithoutAStep)
{
    auto check = consistency(2);
    check.add_verified("A", 10);
    EXPECT_TRUE(check.add_verified("A", 5000));
}

TEST(TemporalConsistency, StartsAgainWhenTheCandidateIsElsewhere)
{
    auto check = consistency(2, 3);
    check.add_verified("A", 10);
    EXPECT_FALSE(check.add_verified("A", 20));
    EXPECT_TRUE(check.add_verified("A", 17));  // backwards along the old path is a step too
    EXPECT_FALSE(check.add_verified("A", 13.9));
}

TEST(TemporalConsistency, CountsEachCameraForItself)
{
    auto check = consistency(2, 3);
    EXPECT_FALSE(check.add_verified("A", 10));
    EXPECT_FALSE(check.add_verified("B", 50));
    check.add_unverified("B");
    EXPECT_TRUE(check.add_verified("A", 11));
    EXPECT_FALSE(check.add_verified("B", 51));
}

}  // namespace
