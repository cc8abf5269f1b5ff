// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/surf.h"

#include <gtest/gtest.h>

#include <set>

namespace
{
constexpr std::size_t kSums = 8;

/** The eight sums of a subregion. */
std::vector<float> subregion(const std::vector<float>& numbers, std::size_t row, std::size_t column)
{
    const auto* first = numbers.data() + (row * 4 + column) * kSums;
    return {first, first + kSums};
}

const std::vector<float> kMean = fild::surf_statistics().mean;
const std::vector<float> kRootedMean = fild::rooted_surf_statistics().mean;
const std::vector<float> kRootedDeviation = fild::rooted_surf_statistics().deviation;

TEST(SurfStatistics, HaveTheSymmetryOfTheGrid)
{
    for (const auto& numbers : {kMean, kRootedMean, kRootedDeviation})
    {
        ASSERT_EQ(numbers.size(), fild::LocalFeatures::dimension);
        std::set<std::vector<float>> kinds;
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t column = 0; column < 4; ++column)
            {
                const auto sums = subregion(numbers, row, column);
                EXPECT_EQ(sums, subregion(numbers, 3 - row, column));
                EXPECT_EQ(sums, subregion(numbers, row, 3 - column));
                EXPECT_EQ(sums, subregion(numbers, column, row));
                kinds.insert(sums);
            }
        EXPECT_EQ(kinds.size(), 3U);
    }
}

TEST(SurfStatistics, AreLargestInTheMiddleWhereTheGaussianIs)
{
    for (const auto& numbers : {kMean, kRootedMean, kRootedDeviation})
        for (std::size_t i = 1; i < kSums; i += 2)  // the sums of absolute values
        {
            EXPECT_GT(subregion(numbers, 1, 1)[i], subregion(numbers, 0, 1)[i]);
            EXPECT_GT(subregion(numbers, 0, 1)[i], subregion(numbers, 0, 0)[i]);
        }
}

TEST(SurfStatistics, AreDividedByOnlyWhenRooted)
{
    EXPECT_EQ(fild::surf_statistics().deviation,
              std::vector<float>(fild::LocalFeatures::dimension, 1.0F));
}

}  // namespace
