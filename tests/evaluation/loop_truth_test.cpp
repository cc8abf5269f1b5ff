// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/loop_truth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using fild::FrameId;
using fild::Judgement;

TEST(LabelTruth, ExactTakesTheLabelledPairOnly)
{
    const fild::LabelTruth truth(fild::to_loop_labels({{20, 5}, {20, 8}}, 30), 0);
    EXPECT_TRUE(truth.is_loop_query(FrameId{20}));
    EXPECT_FALSE(truth.is_loop_query(FrameId{5}));
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{5}), Judgement::right);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{8}), Judgement::right);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{6}), Judgement::wrong);
    EXPECT_EQ(truth.judge(FrameId{21}, FrameId{5}), Judgement::wrong);
}

TEST(LabelTruth, WindowTakesNeighbouringColumns)
{
    const fild::LabelTruth truth(fild::to_loop_labels({{20, 5}}, 30), 2);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{2}), Judgement::wrong);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{3}), Judgement::right);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{7}), Judgement::right);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{8}), Judgement::wrong);
    EXPECT_EQ(truth.judge(FrameId{19}, FrameId{5}), Judgement::wrong);  // columns, not rows
}

TEST(LabelTruth, ADoubtfulPairIsNeitherRightNorWrong)
{
    auto labels = fild::to_loop_labels({{20, 5}}, 30);
    labels.doubtful = {{20, 9}, {21, 5}};
    const fild::LabelTruth truth(labels, 2);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{9}), Judgement::neither);
    EXPECT_EQ(truth.judge(FrameId{21}, FrameId{5}), Judgement::neither);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{10}), Judgement::wrong);
    EXPECT_FALSE(truth.is_loop_query(FrameId{21}));
}

TEST(LabelTruth, WindowBeginsAtFrameZero)
{
    const fild::LabelTruth truth(fild::to_loop_labels({{20, 1}}, 30), 40);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{0}), Judgement::right);
    EXPECT_EQ(truth.judge(FrameId{20}, FrameId{19}), Judgement::right);
}

TEST(LabelTruth, AQueryWithALabelErrorOnlyCannotBeAnswered)
{
    const fild::LabelTruth truth(fild::to_loop_labels({{0, 9}, {8, 1}, {9, 1}}, 10), 5);
    EXPECT_TRUE(truth.is_loop_query(FrameId{0}));
    EXPECT_EQ(truth.judge(FrameId{9}, FrameId{1}), Judgement::right);
}

/** A camera looking along x at the metre `x`, turned to the left by `degrees`. */
fild::PosedFrame at(double seconds, double x, double degrees = 0)
{
    const double angle = degrees * 0.017453292519943295;
    fild::FramePose pose;
    pose.rotation = {
        std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1};
    pose.position = {x, 0, 0};
    return {seconds, pose};
}

TEST(PoseTruth, AsksForRadiusAngleAndAge)
{
    fild::Protocol protocol = fild::parse_protocol("radius:2");
    protocol.max_angle_deg = 30;
    protocol.min_age_seconds = 10;
    const fild::PoseTruth truth({at(0, 0),
                                 at(1, 2.5),
                                 at(2, 1.9, 29),
                                 at(3, 0, 31),
                                 {4, std::nullopt},
                                 at(6, 50),
                                 at(8, 0),
                                 at(12, 0),
                                 at(30, 50)},
                                protocol);
    const FrameId query{7};
    EXPECT_TRUE(truth.is_loop_query(query));
    EXPECT_EQ(truth.judge(query, FrameId{0}), Judgement::right);
    EXPECT_EQ(truth.judge(query, FrameId{1}), Judgement::wrong);  // too far
    EXPECT_EQ(truth.judge(query, FrameId{2}), Judgement::right);
    EXPECT_EQ(truth.judge(query, FrameId{3}), Judgement::wrong);  // turned away
    EXPECT_EQ(truth.judge(query, FrameId{4}), Judgement::neither);  // no pose
    EXPECT_EQ(truth.judge(query, FrameId{5}), Judgement::wrong);
    EXPECT_EQ(truth.judge(query, FrameId{6}), Judgement::neither);  // four seconds old
    EXPECT_FALSE(truth.is_loop_query(FrameId{6}));  // of eight seconds, ten are asked for
    EXPECT_FALSE(truth.is_loop_query(FrameId{0}));
    EXPECT_TRUE(truth.is_loop_query(FrameId{8}));
}

TEST(PoseTruth, DoubtsPairsFromFurtherOff)
{
    auto protocol = fild::parse_protocol("radius:2,5");
    protocol.min_age_seconds = 0;
    const fild::PoseTruth truth(
        {at(0, 0, 0), at(1, 4, 0), at(2, 6, 0), at(3, 1, 80), at(4, 1, 100), at(9, 0, 0)},
        protocol);
    const FrameId query{5};
    EXPECT_EQ(truth.judge(query, FrameId{0}), Judgement::right);
    EXPECT_EQ(truth.judge(query, FrameId{1}), Judgement::neither);
    EXPECT_EQ(truth.judge(query, FrameId{2}), Judgement::wrong);
    EXPECT_EQ(truth.judge(query, FrameId{3}), Judgement::neither);  // 80 degrees
    EXPECT_EQ(truth.judge(query, FrameId{4}), Judgement::wrong);  // 100 degrees
}

}  // namespace
