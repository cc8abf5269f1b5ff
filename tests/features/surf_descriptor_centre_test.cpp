// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/surf.h"

#include <gtest/gtest.h>

#include <set>

namespace
{
constexpr std::size_t kSums = 8;

/** The eight sums of a subregion. */
std::vector<float> subregion(std::size_t row, std::size_t column)
{
    const auto centre = fild::surf_descriptor_centre();
    const auto* first = centre.data() + (row * 4 + column) * kSums;
    return {first, first + kSums};
}

TEST(SurfDescriptorCentre, HasTheSymmetryOfTheGrid)
{
    ASSERT_EQ(fild::surf_descriptor_centre().size(), fild::LocalFeatures::dimension);
    std::set<std::vector<float>> kinds;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column)
        {
            const auto sums = subregion(row, column);
            EXPECT_EQ(sums, subregion(3 - row, column));
            EXPECT_EQ(sums, subregion(row, 3 - column));
            EXPECT_EQ(sums, subregion(column, row));
            kinds.insert(sums);
        }
    EXPECT_EQ(kinds.size(), 3U);
}

TEST(SurfDescriptorCentre, IsLargestInTheMiddleWhereTheGaussianIs)
{
    for (std::size_t i = 1; i < kSums; i += 2)  // the sums of absolute values
    {
        EXPECT_GT(subregion(1, 1)[i], subregion(0, 1)[i]);
        EXPECT_GT(subregion(0, 1)[i], subregion(0, 0)[i]);
    }
}

}  // namespace
