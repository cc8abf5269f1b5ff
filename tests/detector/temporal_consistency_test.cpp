// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/temporal_consistency.h"

#include <gtest/gtest.h>

namespace
{
fild::TemporalConsistency consistency(int frames, double max_step = 0, int sure_inliers = 0)
{
    fild::TConsistencyOptions options;
    options.consecutive_frames = frames;
    options.max_candidate_step_seconds = max_step;
    options.sure_inliers = sure_inliers;
    return fild::TemporalConsistency(options);
}

TEST(TemporalConsistency, AcceptsFromTheLastOfBetaFramesOn)
{
    auto check = consistency(3);
    EXPECT_FALSE(check.add_verified(10, 30, 500));
    EXPECT_FALSE(check.add_verified(11, 30, 500));
    EXPECT_TRUE(check.add_verified(12, 30, 500));
    EXPECT_TRUE(check.add_verified(13, 30, 500));
}

TEST(TemporalConsistency, StartsAgainAfterAnUnverifiedFrame)
{
    auto check = consistency(2);
    check.add_verified(10, 30, 500);
    check.add_unverified();
    EXPECT_FALSE(check.add_verified(11, 30, 500));
    EXPECT_TRUE(check.add_verified(12, 30, 500));
}

TEST(TemporalConsistency, BetaOneAcceptsAtOnce)
{
    EXPECT_TRUE(consistency(1).add_verified(0, 30, 500));
}

TEST(TemporalConsistency, TakesAnyCandidatesWithoutAStep)
{
    auto check = consistency(2);
    check.add_verified(10, 30, 500);
    EXPECT_TRUE(check.add_verified(5000, 30, 500));
}

TEST(TemporalConsistency, StartsAgainWhenTheCandidateIsElsewhere)
{
    auto check = consistency(2, 3);
    check.add_verified(10, 30, 500);
    EXPECT_FALSE(check.add_verified(20, 30, 500));
    EXPECT_TRUE(check.add_verified(17, 30, 500));  // backwards along the old path is a step too
    EXPECT_FALSE(check.add_verified(13.9, 30, 500));
}

TEST(TemporalConsistency, TakesASureFrameAtOnceAndCountsItInTheRow)
{
    auto check = consistency(2, 0, 40);
    EXPECT_FALSE(check.add_verified(10, 39, 500));
    check.add_unverified();
    EXPECT_TRUE(check.add_verified(10, 40, 500));
    EXPECT_TRUE(check.add_verified(11, 30, 500));
}

TEST(TemporalConsistency, ASureFrameHasEnoughInliersForItsKeypoints)
{
    fild::TConsistencyOptions options;
    options.consecutive_frames = 2;
    options.sure_inliers = 40;
    options.sure_inlier_share = 0.05;
    fild::TemporalConsistency check(options);
    EXPECT_FALSE(check.add_verified(10, 99, 2000));
    check.add_unverified();
    EXPECT_TRUE(check.add_verified(10, 100, 2000));
    check.add_unverified();
    EXPECT_FALSE(check.add_verified(10, 39, 100));
}

}  // namespace
