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
    EXPECT_FALSE(check.add_verified(10));
    EXPECT_FALSE(check.add_verified(11));
    EXPECT_TRUE(check.add_verified(12));
    EXPECT_TRUE(check.add_verified(13));
}

TEST(TemporalConsistency, StartsAgainAfterAnUnverifiedFrame)
{
    auto check = consistency(2);
    check.add_verified(10);
    check.add_unverified();
    EXPECT_FALSE(check.add_verified(11));
    EXPECT_TRUE(check.add_verified(12));
}

TEST(TemporalConsistency, BetaOneAcceptsAtOnce)
{
    EXPECT_TRUE(consistency(1).add_verified(0));
}

TEST(TemporalConsistency, TakesAnyCandidatesWithoutAStep)
{
    auto check = consistency(2);
    check.add_verified(10);
    EXPECT_TRUE(check.add_verified(5000));
}

TEST(TemporalConsistency, StartsAgainWhenTheCandidateIsElsewhere)
{
    auto check = consistency(2, 3);
    check.add_verified(10);
    EXPECT_FALSE(check.add_verified(20));
    EXPECT_TRUE(check.add_verified(17));  // backwards along the old path is a step too
    EXPECT_FALSE(check.add_verified(13.9));
}

}  // namespace
