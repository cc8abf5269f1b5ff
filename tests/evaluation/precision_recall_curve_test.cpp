// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/precision_recall_curve.h"

#include "judged.h"

#include <gtest/gtest.h>

namespace
{
using fild::Judgement;
using fild::ScoreKind;
using fild::testing::judged;
using fild::testing::numbered;
using fild::testing::unanswered;

/** Five loop queries. By inliers: 90 right, 80 right, 70 one right and one wrong, 50 wrong, 30
 *  right; one query has no candidate; what is neither would lead if it counted. */
std::vector<fild::JudgedFrame> frames_with_a_tie()
{
    return numbered({judged(Judgement::wrong, 70, false),
                     judged(Judgement::right, 90, true, fild::Rejection::none),
                     judged(Judgement::right, 30, true),
                     judged(Judgement::neither, 99, false, fild::Rejection::none),
                     judged(Judgement::right, 80, true),
                     unanswered(true),
                     judged(Judgement::wrong, 50, false),
                     judged(Judgement::right, 70, true),
                     unanswered(false)});
}

TEST(PrecisionRecallCurve, CountsByHand)
{
    const auto curve = fild::precision_recall_curve(frames_with_a_tie(), ScoreKind::inliers);
    ASSERT_EQ(curve.points.size(), 5U);
    const std::vector<double> thresholds{90, 80, 70, 50, 30};
    const std::vector<std::size_t> accepted{1, 2, 4, 5, 6};
    const std::vector<std::size_t> right{1, 2, 3, 3, 4};
    for (std::size_t i = 0; i < 5; ++i)
    {
        const auto& point = curve.points[i];
        EXPECT_DOUBLE_EQ(point.threshold, thresholds[i]);
        EXPECT_EQ(point.accepted, accepted[i]);
        EXPECT_EQ(point.right, right[i]);
        EXPECT_DOUBLE_EQ(point.precision,
                         static_cast<double>(right[i]) / static_cast<double>(accepted[i]));
        EXPECT_DOUBLE_EQ(point.recall.value(), static_cast<double>(right[i]) / 5);
    }
}

TEST(PrecisionRecallCurve, IsPerfectDownToTheFirstWrongOneAndNotWithinATie)
{
    const auto curve = fild::precision_recall_curve(frames_with_a_tie(), ScoreKind::inliers);
    EXPECT_DOUBLE_EQ(curve.recall_at_full_precision().value(), 0.4);
    EXPECT_DOUBLE_EQ(curve.at_full_precision()->threshold, 80);
}

// F1 = 2 right / (accepted + loop queries): 2/6, 4/7, 6/9, 6/10, 8/11.
TEST(PrecisionRecallCurve, HasItsGreatestF1)
{
    const auto curve = fild::precision_recall_curve(frames_with_a_tie(), ScoreKind::inliers);
    EXPECT_DOUBLE_EQ(curve.at_max_f1()->threshold, 30);
    EXPECT_DOUBLE_EQ(curve.at_max_f1()->f1().value(), 8.0 / 11);
}

// 1/5 * 1 + 1/5 * 1 + 1/5 * 3/4 + 0 + 1/5 * 4/6
TEST(PrecisionRecallCurve, HasAveragePrecision)
{
    const auto curve = fild::precision_recall_curve(frames_with_a_tie(), ScoreKind::inliers);
    EXPECT_NEAR(curve.average_precision().value(), (1 + 1 + 0.75 + 4.0 / 6) / 5, 1e-12);
}

TEST(PrecisionRecallCurve, OverSimilarityRanksBySimilarity)
{
    auto frames = frames_with_a_tie();
    frames[2].verdict.candidate->similarity = 0.95;  // 30 inliers, right
    frames[0].verdict.candidate->similarity = 0.92;  // wrong
    const auto curve = fild::precision_recall_curve(frames, ScoreKind::similarity);
    EXPECT_EQ(curve.kind, ScoreKind::similarity);
    EXPECT_DOUBLE_EQ(curve.points.front().threshold, 0.95);
    EXPECT_DOUBLE_EQ(curve.recall_at_full_precision().value(), 0.2);
}

TEST(PrecisionRecallCurve, HasNoPerfectThresholdWhenTheBestIsWrong)
{
    const auto curve = fild::precision_recall_curve(
        numbered({judged(Judgement::wrong, 9, true), judged(Judgement::right, 9, true)}),
        ScoreKind::inliers);
    EXPECT_FALSE(curve.at_full_precision());
    EXPECT_DOUBLE_EQ(curve.recall_at_full_precision().value(), 0);
    EXPECT_DOUBLE_EQ(curve.average_precision().value(), 0.25);
}

TEST(PrecisionRecallCurve, OfSeveralGreatestF1TakesTheHighestThreshold)
{
    const auto curve = fild::precision_recall_curve(
        numbered({judged(Judgement::wrong, 9, true), judged(Judgement::wrong, 5, true)}),
        ScoreKind::inliers);
    EXPECT_DOUBLE_EQ(curve.at_max_f1()->f1().value(), 0);
    EXPECT_DOUBLE_EQ(curve.at_max_f1()->threshold, 9);
}

TEST(PrecisionRecallCurve, WithoutALoopQueryHasNoRecall)
{
    const auto curve = fild::precision_recall_curve(numbered({judged(Judgement::wrong, 9, false)}),
                                                    ScoreKind::inliers);
    EXPECT_DOUBLE_EQ(curve.points.at(0).precision, 0);
    EXPECT_FALSE(curve.points[0].recall);
    EXPECT_FALSE(curve.points[0].f1());
    EXPECT_FALSE(curve.recall_at_full_precision());
    EXPECT_FALSE(curve.at_max_f1());
    EXPECT_FALSE(curve.average_precision());
}

TEST(PrecisionRecallCurve, WithoutACandidateHasNoPoint)
{
    const auto curve =
        fild::precision_recall_curve(numbered({unanswered(true)}), ScoreKind::inliers);
    EXPECT_TRUE(curve.points.empty());
    EXPECT_DOUBLE_EQ(curve.recall_at_full_precision().value(), 0);
    EXPECT_DOUBLE_EQ(curve.average_precision().value(), 0);
    EXPECT_FALSE(curve.at_max_f1());
}

}  // namespace
