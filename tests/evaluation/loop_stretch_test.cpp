// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_stretch.h"

#include "judged.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
using fild::Judgement;
using fild::Rejection;
using fild::testing::judged;
using fild::testing::numbered;
using fild::testing::unanswered;

/** A letter a frame: q missed loop query, r rightly answered, w wrongly answered, R right but
 *  rejected, others no loop query. */
std::vector<fild::LoopStretch> stretches_of(const std::string& letters)
{
    std::vector<fild::JudgedFrame> frames;
    for (const char letter : letters)
        if (letter == 'r')
            frames.push_back(judged(Judgement::right, 9, true, Rejection::none));
        else if (letter == 'w')
            frames.push_back(judged(Judgement::wrong, 9, true, Rejection::none));
        else if (letter == 'R')
            frames.push_back(judged(Judgement::right, 9, true, Rejection::not_consistent_yet));
        else
            frames.push_back(unanswered(letter == 'q'));
    return fild::loop_stretches(numbered(frames));
}

TEST(LoopStretches, ReachOverGapsOfThreeFrames)
{
    const auto stretches = stretches_of("..qq...r....q");
    ASSERT_EQ(stretches.size(), 2U);
    EXPECT_EQ(stretches[0].first, fild::FrameId{2});
    EXPECT_EQ(stretches[0].last, fild::FrameId{7});
    EXPECT_EQ(stretches[0].loop_queries, 3U);
    EXPECT_EQ(stretches[0].answered, 1U);
    EXPECT_EQ(stretches[1].first, fild::FrameId{12});
    EXPECT_EQ(stretches[1].last, fild::FrameId{12});
    EXPECT_FALSE(stretches[1].found());
}

TEST(LoopStretches, AreFoundByARightLoopClosureOnly)
{
    const auto stretches = stretches_of("qwq....RRR....wrr....r");
    ASSERT_EQ(stretches.size(), 4U);
    EXPECT_FALSE(stretches[0].found());
    EXPECT_FALSE(stretches[1].found());
    EXPECT_TRUE(stretches[2].found());
    EXPECT_TRUE(stretches[3].found());
    EXPECT_EQ(fild::count_found(stretches), 2U);
    EXPECT_DOUBLE_EQ(fild::segment_recall(stretches).value(), 0.5);
}

TEST(LoopStretches, AreNoneWithoutALoopQuery)
{
    EXPECT_TRUE(stretches_of("....").empty());
    EXPECT_FALSE(fild::segment_recall({}));
}

}  // namespace
