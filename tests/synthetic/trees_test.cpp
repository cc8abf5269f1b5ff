// SPDX-License-Identifier: BSD-3-Clause
#include "trees.h"

#include <gtest/gtest.h>

namespace
{
using fild::foliage_of;
using fild::StandingObject;

StandingObject tree(std::uint64_t seed)
{
    return {{0, 0}, 0, seed};
}

TEST(Foliage, IsFullAndGreenInSummer)
{
    for (std::uint64_t seed = 0; seed < 50; ++seed)
    {
        EXPECT_EQ(foliage_of(tree(seed), 0).density, 1);
        EXPECT_EQ(foliage_of(tree(seed), 0).colour, 0);
    }
}

TEST(Foliage, TurnsAndFallsInAutumn)
{
    int bare = 0;
    int green = 0;
    int thinner_later = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed)
    {
        const auto late = foliage_of(tree(seed), 1);
        EXPECT_GE(late.density, 0);
        EXPECT_LT(late.density, 1);
        bare += late.density == 0 ? 1 : 0;
        green += late.colour == 0 ? 1 : 0;
        thinner_later += late.density < foliage_of(tree(seed), 0.6).density ? 1 : 0;
    }
    EXPECT_GT(bare, 20);
    EXPECT_LT(bare, 100);
    EXPECT_EQ(green, 0);
    EXPECT_GT(thinner_later, 190 - bare);
}

TEST(Foliage, DependsOnTheTree)
{
    EXPECT_NE(foliage_of(tree(1), 0.8).density, foliage_of(tree(2), 0.8).density);
    EXPECT_EQ(foliage_of(tree(1), 0.8).density, foliage_of(tree(1), 0.8).density);
}

}  // namespace
