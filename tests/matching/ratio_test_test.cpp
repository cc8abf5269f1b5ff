// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/ratio_test.h"

#include <gtest/gtest.h>

namespace
{
using fild::passes_ratio_test;

TEST(RatioTest, ComparesWithTheSquareOfEpsilon)
{
    EXPECT_TRUE(passes_ratio_test(25, 100, 0.5));
    EXPECT_FALSE(passes_ratio_test(26, 100, 0.5));
}

TEST(RatioTest, TakesAnExactCopyBesideADistantSecond)
{
    EXPECT_TRUE(passes_ratio_test(0, 1, 0.7));
}

TEST(RatioTest, RejectsTwoIdenticalCodes)
{
    EXPECT_FALSE(passes_ratio_test(0, 0, 1.0));
}

TEST(RatioTest, EpsilonOneKeepsEvenTies)
{
    EXPECT_TRUE(passes_ratio_test(256, 256, 1.0));
}

}  // namespace
