// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/spread.h"

#include <gtest/gtest.h>

namespace
{
using Indices = std::vector<std::size_t>;

TEST(SpreadIndices, ReachFromTheFirstToTheLast)
{
    EXPECT_EQ(fild::spread_indices(3, 7), (Indices{0, 3, 6}));
    EXPECT_EQ(fild::spread_indices(2, 100), (Indices{0, 99}));
}

TEST(SpreadIndices, AreAllWhenThereAreNoMore)
{
    EXPECT_EQ(fild::spread_indices(9, 3), (Indices{0, 1, 2}));
    EXPECT_EQ(fild::spread_indices(9, 0), Indices{});
    EXPECT_EQ(fild::spread_indices(0, 9), Indices{});
}

TEST(SpreadIndices, OneIsInTheMiddle)
{
    EXPECT_EQ(fild::spread_indices(1, 9), Indices{4});
}

}  // namespace
