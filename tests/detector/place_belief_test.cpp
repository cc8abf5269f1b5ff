// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/place_belief.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{
using fild::ComparedPlace;
using fild::FrameId;
using fild::PairOdds;

fild::PlaceBelief belief_of(std::size_t places)
{
    fild::TConsistencyOptions options;
    options.belief = true;
    fild::PlaceBelief belief(options);
    for (std::size_t i = 0; i < places; ++i) belief.add_place(FrameId{i});
    return belief;
}

/** The frame is compared with one place, and with three others in vain. */
std::vector<ComparedPlace> seen_at(std::uint64_t place, const PairOdds& odds)
{
    return {{FrameId{place}, odds},
            {FrameId{90}, std::nullopt},
            {FrameId{91}, std::nullopt},
            {FrameId{92}, std::nullopt}};
}

TEST(PlaceBelief, BeginsOnNewGround)
{
    auto belief = belief_of(100);
    EXPECT_FALSE(belief.likeliest());
    EXPECT_EQ(belief.update({}), 0);
    EXPECT_FALSE(belief.likeliest());
}

TEST(PlaceBelief, DoesNotBelieveASingleFairlyGoodFrameButARowOfThem)
{
    auto belief = belief_of(100);
    const PairOdds fair{3, 3};
    EXPECT_LT(belief.update(seen_at(10, fair)), 0.8);
    belief.update(seen_at(11, fair));
    belief.update(seen_at(12, fair));
    EXPECT_GT(belief.update(seen_at(13, fair)), 0.95);
    EXPECT_EQ(*belief.likeliest(), FrameId{13});
}

TEST(PlaceBelief, BelievesASingleFrameThatLeavesNoDoubt)
{
    auto belief = belief_of(100);
    EXPECT_GT(belief.update(seen_at(10, {12, 10})), 0.98);
}

TEST(PlaceBelief, BelievesAFrameOfDoubtInsideAReturnButNotInNowhere)
{
    const PairOdds doubt{1, 1};
    auto belief = belief_of(100);
    for (std::uint64_t i = 0; i < 5; ++i) belief.update(seen_at(10 + i, {8, 5}));
    EXPECT_GT(belief.update(seen_at(15, doubt)), 0.95);
    EXPECT_LT(belief_of(100).update(seen_at(15, doubt)), 0.3);
}

TEST(PlaceBelief, DoubtsAJumpToAFarPlaceButNotANearOne)
{
    const PairOdds without_a_word_on_look_alikes{4, 0};
    const auto belief_after_jump_to = [&](std::uint64_t place)
    {
        auto belief = belief_of(100);
        for (std::uint64_t i = 0; i < 5; ++i) belief.update(seen_at(10 + i, {8, 5}));
        belief.update(seen_at(place, without_a_word_on_look_alikes));
        return belief.update(seen_at(place, without_a_word_on_look_alikes));
    };
    EXPECT_GT(belief_after_jump_to(30), 0.95);
    EXPECT_LT(belief_after_jump_to(70), 0.6);
}

TEST(PlaceBelief, TakesFramesOfOneInstantForOnePlace)
{
    auto belief = belief_of(5);
    belief.add_place(FrameId{5}, true);
    belief.add_place(FrameId{6});
    EXPECT_EQ(belief.place_of(FrameId{4}), 4U);
    EXPECT_EQ(belief.place_of(FrameId{5}), 4U);
    EXPECT_EQ(belief.place_of(FrameId{6}), 5U);
    EXPECT_EQ(belief.states().same.size(), 6U);
    belief.update({{FrameId{4}, {{8, 5}}}, {FrameId{5}, {{8, 5}}}});
    EXPECT_EQ(belief.evidence().entrances.size(), 1U);
    EXPECT_EQ(*belief.likeliest(), FrameId{4});
}

TEST(PlaceBelief, MovesOnceInAnInstant)
{
    const auto share_of_place_10 = [](int further_cameras, bool has_moved)
    {
        auto belief = belief_of(100);
        belief.update(seen_at(10, {12, 10}));
        for (int i = 0; i < further_cameras; ++i) belief.update({}, has_moved);
        return belief.states().same[10] / fild::sum_of(belief.states().same);
    };
    EXPECT_DOUBLE_EQ(share_of_place_10(3, false), share_of_place_10(0, false));
    EXPECT_LT(share_of_place_10(3, true), 0.7 * share_of_place_10(0, true));
}

TEST(PlaceBelief, FollowsThePathBackwardToo)
{
    auto belief = belief_of(100);
    for (std::uint64_t i = 0; i < 5; ++i) belief.update(seen_at(60 - 2 * i, {4, 4}));
    EXPECT_GT(belief.update(seen_at(50, {2, 2})), 0.95);
}

/** Two floors of one building: each frame fits, and each frame has what a true return has not. */
TEST(PlaceBelief, DoesNotBelieveARowOfLookAlikesForOneFrameThatConvinces)
{
    auto belief = belief_of(100);
    for (std::uint64_t i = 0; i < 8; ++i) EXPECT_LT(belief.update(seen_at(10 + i, {10, -2})), 0.5);
    EXPECT_LT(belief.update(seen_at(18, {10, 6})), 0.5);
    EXPECT_FALSE(belief.likeliest());
}

/** Bushes that match worse than walls do, in the middle of a sure return: the camera has not left
 *  for a look-alike beside it. */
TEST(PlaceBelief, KeepsToAReturnWhereTheViewMatchesWorseForAWhile)
{
    auto belief = belief_of(200);
    for (std::uint64_t i = 0; i < 40; ++i) belief.update(seen_at(10 + i, {8, 4}));
    double probability = 1;
    for (std::uint64_t i = 0; i < 30; ++i) probability = belief.update(seen_at(50 + i, {4, -0.3}));
    EXPECT_GT(probability, 0.95);
}

TEST(PlaceBelief, LeavesAPlaceThatIsNotSeenAnyMore)
{
    auto belief = belief_of(100);
    for (std::uint64_t i = 0; i < 5; ++i) belief.update(seen_at(10 + i, {8, 5}));
    double probability = 1;
    for (int i = 0; i < 8; ++i) probability = belief.update(seen_at(70, {-8, 0}));
    EXPECT_LT(probability, 0.1);
}

TEST(PlaceBelief, JumpsToAnotherPlace)
{
    auto belief = belief_of(100);
    for (std::uint64_t i = 0; i < 5; ++i) belief.update(seen_at(10 + i, {8, 5}));
    EXPECT_GT(belief.update(seen_at(70, {8, 5})), 0.95);
    EXPECT_EQ(*belief.likeliest(), FrameId{70});
}

TEST(PlaceBelief, RemainsAProbabilityForThousandsOfFrames)
{
    auto belief = belief_of(300);
    for (std::uint64_t i = 0; i < 3000; ++i)
    {
        const double p = belief.update(seen_at(i % 300, {i % 7 == 0 ? 12.0 : -12.0, 6}));
        ASSERT_GE(p, 0);
        ASSERT_LE(p, 1 + 1e-12);
    }
}

}  // namespace
