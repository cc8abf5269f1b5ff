// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/lost_loop.h"

#include "drawn_truth.h"
#include "fild/evaluation/loop_labels.h"
#include "fild/evaluation/worst_wrong_pair.h"

#include <gtest/gtest.h>

#include <optional>

namespace
{
using fild::ConsideredCandidate;
using fild::FrameId;
using fild::LossStage;
using fild::Rejection;

constexpr std::size_t kQuery = 9;

/** Frame 9 is back at 1 and at 2. */
fild::LabelTruth truth()
{
    return {fild::to_loop_labels({{kQuery, 1}, {kQuery, 2}}, 10), 0};
}

ConsideredCandidate answer(std::size_t rank,
                           std::size_t candidate,
                           bool checked = false,
                           Rejection rejection = Rejection::none,
                           std::size_t inliers = 0)
{
    return {{FrameId{candidate}, 0.5}, rank, checked, 0, inliers, 0, rejection};
}

/** The stage at which frame 9 is lost; none: it is not. */
std::optional<LossStage> stage_of(const std::vector<ConsideredCandidate>& answers,
                                  std::optional<std::size_t> reported,
                                  Rejection rejection)
{
    auto frames = fild::testing::frames_at_one_hertz(10);
    if (reported) frames[kQuery].candidate = fild::Candidate{FrameId{*reported}, 0.5};
    frames[kQuery].rejection = rejection;
    fild::AnswersOfFrames all(10);
    all[kQuery] = answers;
    const auto labels = truth();
    const auto lost = fild::lost_loops(fild::judge_frames(frames, labels), all, labels);
    if (lost.empty()) return std::nullopt;
    EXPECT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].frame, FrameId{kQuery});
    return lost[0].stage;
}

TEST(LostLoops, AreNoneWhenTheAnswerIsRight)
{
    EXPECT_FALSE(stage_of({answer(1, 1, true)}, 1, Rejection::none));
}

TEST(LostLoops, OfFramesThatHadNoChance)
{
    EXPECT_EQ(stage_of({}, std::nullopt, Rejection::missing_image), LossStage::frame);
    EXPECT_EQ(stage_of({}, std::nullopt, Rejection::repeated_timestamp), LossStage::frame);
    EXPECT_EQ(stage_of({}, std::nullopt, Rejection::too_early), LossStage::too_early);
}

TEST(LostLoops, InRetrievalWhenNoTrueCandidateWasChecked)
{
    EXPECT_EQ(stage_of({}, std::nullopt, Rejection::no_candidate), LossStage::retrieval);
    EXPECT_EQ(stage_of({answer(1, 5, true, Rejection::too_few_inliers), answer(2, 1)},
                       5,
                       Rejection::too_few_inliers),
              LossStage::retrieval);
    EXPECT_EQ(stage_of({answer(1, 5, true)}, 5, Rejection::none), LossStage::retrieval);
}

TEST(LostLoops, InMatchingAndGeometry)
{
    EXPECT_EQ(
        stage_of({answer(1, 1, true, Rejection::too_few_matches)}, 1, Rejection::too_few_matches),
        LossStage::matching);
    EXPECT_EQ(stage_of({answer(1, 1, true, Rejection::no_model)}, 1, Rejection::no_model),
              LossStage::geometry);
    EXPECT_EQ(
        stage_of({answer(1, 1, true, Rejection::too_few_inliers)}, 1, Rejection::too_few_inliers),
        LossStage::geometry);
}

TEST(LostLoops, OfSeveralTrueCandidatesTheFurthestCounts)
{
    EXPECT_EQ(stage_of({answer(1, 1, true, Rejection::too_few_inliers),
                        answer(2, 2, true, Rejection::too_few_matches)},
                       1,
                       Rejection::too_few_inliers),
              LossStage::geometry);
    EXPECT_EQ(stage_of({answer(1, 1, true, Rejection::too_few_matches), answer(0, 2, true)},
                       2,
                       Rejection::not_consistent_yet),
              LossStage::consistency);
}

TEST(LostLoops, InChoiceWhenAnotherWasReported)
{
    const std::vector<ConsideredCandidate> both{answer(1, 5, true), answer(2, 1, true)};
    EXPECT_EQ(stage_of(both, 5, Rejection::none), LossStage::choice);
    EXPECT_EQ(stage_of(both, 5, Rejection::not_consistent_yet), LossStage::choice);
    EXPECT_EQ(stage_of(both, 1, Rejection::not_consistent_yet), LossStage::consistency);
}

TEST(CandidateRecall, CountsAnswersUpToTheRank)
{
    const auto frames = fild::testing::frames_at_one_hertz(10);
    const fild::LabelTruth labels(fild::to_loop_labels({{6, 0}, {7, 1}, {8, 2}, {kQuery, 3}}, 10),
                                  0);
    fild::AnswersOfFrames answers(10);
    answers[5] = {answer(1, 0)};  // no loop query
    answers[6] = {answer(1, 0), answer(2, 4)};
    answers[7] = {answer(1, 4), answer(2, 1)};
    answers[8] = {answer(1, 4), answer(0, 2, true)};  // not out of the index
    const auto judged = fild::judge_frames(frames, labels);
    EXPECT_DOUBLE_EQ(fild::candidate_recall(judged, answers, labels, 1).value(), 0.25);
    EXPECT_DOUBLE_EQ(fild::candidate_recall(judged, answers, labels, 2).value(), 0.5);
    EXPECT_DOUBLE_EQ(fild::candidate_recall(judged, answers, labels, 10).value(), 0.5);
}

TEST(CandidateRecall, IsNoneWithoutALoopQuery)
{
    const fild::PoseTruth nowhere(std::vector<fild::PosedFrame>(2),
                                  fild::parse_protocol("radius:1"));
    const auto frames = fild::judge_frames(fild::testing::frames_at_one_hertz(2), nowhere);
    EXPECT_FALSE(fild::candidate_recall(frames, fild::AnswersOfFrames(2), nowhere, 1));
}

TEST(WorstWrongPair, HasTheMostSupportOfTheWrongOnes)
{
    auto frames = fild::testing::frames_at_one_hertz(10);
    fild::testing::accept(frames, kQuery, 1);  // right
    frames[kQuery].support = 9;
    frames[6].candidate = fild::Candidate{FrameId{3}, 0.5};
    frames[6].inliers = 25;
    frames[6].support = 0.4;
    frames[7].candidate = fild::Candidate{FrameId{2}, 0.5};
    frames[7].inliers = 30;
    frames[7].support = 0.3;
    const auto worst = fild::worst_wrong_pair(fild::judge_frames(frames, truth()));
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->frame, FrameId{6});
    EXPECT_EQ(worst->candidate, FrameId{3});
    EXPECT_EQ(worst->inliers, 25U);
    EXPECT_EQ(worst->support, 0.4);
    EXPECT_FALSE(worst->accepted);
    fild::testing::accept(frames, 5, 0);
    frames[5].support = 1.5;
    EXPECT_TRUE(fild::worst_wrong_pair(fild::judge_frames(frames, truth()))->accepted);
}

TEST(WorstWrongPair, IsNoneWhenNothingIsWrong)
{
    const auto labels = truth();
    const auto judged = fild::judge_frames(fild::testing::frames_at_one_hertz(10), labels);
    EXPECT_FALSE(fild::worst_wrong_pair(judged));
}

}  // namespace
