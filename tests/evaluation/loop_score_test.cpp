// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_score.h"

#include "drawn_truth.h"
#include "fild/evaluation/loop_labels.h"

#include <gtest/gtest.h>

namespace
{
using fild::testing::accept;
using fild::testing::frames_at_one_hertz;

// Queries 6, 7, 8, 9 come back to 0, 1, 2, 3; found: 6 and 7 rightly, 8 at another place, 9 not at
// all, and 5, which has no loop.
TEST(ScoreLoops, CountsByHand)
{
    auto frames = frames_at_one_hertz(10);
    accept(frames, 5, 0);
    accept(frames, 6, 0);
    accept(frames, 7, 1);
    accept(frames, 8, 0);
    const fild::LabelTruth truth(fild::to_loop_labels({{6, 0}, {7, 1}, {8, 2}, {9, 3}}, 10), 0);
    const auto score = fild::score_loops(fild::judge_frames(frames, truth));
    EXPECT_EQ(score.frames, 10U);
    EXPECT_EQ(score.loop_queries, 4U);
    EXPECT_EQ(score.accepted, 4U);
    EXPECT_EQ(score.right, 2U);
    EXPECT_EQ(score.neither, 0U);
    EXPECT_EQ(score.missed(), 2U);
    EXPECT_DOUBLE_EQ(score.precision().value(), 0.5);
    EXPECT_DOUBLE_EQ(score.recall().value(), 0.5);
    ASSERT_EQ(score.wrong_loops.size(), 2U);
    EXPECT_EQ(score.wrong_loops[0].verdict.frame, fild::FrameId{5});
    EXPECT_FALSE(score.wrong_loops[0].loop_query);
    EXPECT_EQ(score.wrong_loops[1].verdict.frame, fild::FrameId{8});
    EXPECT_TRUE(score.wrong_loops[1].loop_query);
}

// 8 is answered wrongly, 9 not at all; both have several true places.
TEST(JudgeFrames, KnowsWhereAMissedLoopIs)
{
    auto frames = frames_at_one_hertz(10);
    accept(frames, 7, 1);
    accept(frames, 8, 6);
    const fild::LabelTruth truth(fild::to_loop_labels({{7, 1}, {8, 1}, {8, 2}, {8, 3}, {9, 4}}, 10),
                                 0);
    const auto judged = fild::judge_frames(frames, truth);
    EXPECT_FALSE(judged[6].true_candidate) << "no loop query";
    EXPECT_FALSE(judged[7].true_candidate) << "found";
    EXPECT_EQ(judged[8].true_candidate, fild::FrameId{2});
    EXPECT_EQ(judged[9].true_candidate, fild::FrameId{4});
}

TEST(ScoreLoops, HasNoPrecisionWithoutLoopClosures)
{
    const fild::LabelTruth truth(fild::to_loop_labels({{6, 0}}, 10), 0);
    const auto score = fild::score_loops(fild::judge_frames(frames_at_one_hertz(10), truth));
    EXPECT_FALSE(score.precision());
    EXPECT_DOUBLE_EQ(score.recall().value(), 0);
}

TEST(ScoreLoops, LeavesOutWhatIsNeitherRightNorWrong)
{
    auto frames = frames_at_one_hertz(5);
    accept(frames, 3, 0);  // the camera stands still: too young
    const std::vector<fild::PosedFrame> poses(5, {0, fild::FramePose{}});
    const auto score = fild::score_loops(
        fild::judge_frames(frames, fild::PoseTruth(poses, fild::parse_protocol("radius:1"))));
    EXPECT_EQ(score.accepted, 1U);
    EXPECT_EQ(score.neither, 1U);
    EXPECT_FALSE(score.precision());
    EXPECT_FALSE(score.recall());
}

}  // namespace
