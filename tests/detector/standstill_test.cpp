// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/standstill.h"

#include "fild/core/random.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
using fild::FrameId;
using fild::HashedFeatures;
using fild::Standstill;

/** Keypoints on a grid, moved to the right, of which some are new. */
HashedFeatures view(float shift_px, std::size_t new_ones = 0, std::uint64_t seed = 1)
{
    HashedFeatures features;
    features.codes.bits = 256;
    features.codes.words_per_code = 4;
    std::mt19937_64 codes(seed);
    std::mt19937_64 others(shift_px == 0 ? 2 : 3);
    for (std::size_t i = 0; i < 100; ++i)
    {
        features.positions.push_back(
            {20 * static_cast<float>(i % 10) + shift_px, 20 * static_cast<float>(i / 10)});
        for (int w = 0; w < 4; ++w)
        {
            const auto code = codes();
            features.codes.words.push_back(i < new_ones ? others() : code);
        }
    }
    return features;
}

TEST(RepeatedShare, CountsKeypointsThatAreWhereTheyWere)
{
    EXPECT_EQ(fild::repeated_share(view(0), view(0)), 1);
    EXPECT_EQ(fild::repeated_share(view(0), view(1.4F)), 1);
    EXPECT_EQ(fild::repeated_share(view(0), view(1.6F)), 0);
    EXPECT_EQ(fild::repeated_share(view(0), view(0, 40)), 0.6);
    EXPECT_EQ(fild::repeated_share(view(0), view(0, 0, 9)), 0) << "others in the same places";
    EXPECT_EQ(fild::repeated_share(HashedFeatures(), HashedFeatures()), 0);
}

TEST(Standstill, BeginsAfterSomeTimeAndEndsWithTheMovement)
{
    Standstill standstill(2);
    EXPECT_FALSE(standstill.add(FrameId{0}, "A", view(50), 0));
    EXPECT_FALSE(standstill.add(FrameId{1}, "A", view(0), 1));
    EXPECT_FALSE(standstill.add(FrameId{2}, "A", view(0.5F), 2));
    EXPECT_EQ(standstill.add(FrameId{3}, "A", view(0, 60), 3), FrameId{1}) << "people walk past";
    EXPECT_EQ(standstill.add(FrameId{4}, "A", view(0), 60), FrameId{1});
    EXPECT_EQ(standstill.moving_seconds(), 2);
    EXPECT_FALSE(standstill.add(FrameId{5}, "A", view(8), 61));
    EXPECT_EQ(standstill.moving_seconds(), 3);
}

TEST(Standstill, IsOfEachCamera)
{
    Standstill standstill(2);
    for (std::uint64_t i = 0; i < 4; ++i)
    {
        const auto now = static_cast<double>(i);
        EXPECT_EQ(standstill.add(FrameId{2 * i}, "A", view(0), now).has_value(), i >= 2);
        EXPECT_FALSE(
            standstill.add(FrameId{2 * i + 1}, "B", view(10 * static_cast<float>(i)), now));
    }
}

TEST(Standstill, IsNotLookedForWithoutASpan)
{
    Standstill standstill(0);
    for (std::uint64_t i = 0; i < 9; ++i)
        EXPECT_FALSE(standstill.add(FrameId{i}, "A", view(0), static_cast<double>(i)));
    EXPECT_EQ(standstill.moving_seconds(), 8);
}

TEST(Standstill, DoesNotTakeASlowCameraForOneThatStands)
{
    Standstill standstill(2);
    for (std::uint64_t i = 0; i < 100; ++i)  // 10 pixels a second, at 10 Hz
        EXPECT_FALSE(standstill.add(
            FrameId{i}, "A", view(static_cast<float>(i)), 0.1 * static_cast<double>(i)));
}

}  // namespace
