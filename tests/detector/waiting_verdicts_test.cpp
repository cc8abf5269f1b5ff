// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/waiting_verdicts.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace
{
using fild::FrameId;
using fild::WaitingVerdict;
using fild::WaitingVerdicts;

fild::TDetectorOptions looking_ahead(double seconds, double frame_rate = 0)
{
    fild::TDetectorOptions options;
    options.consistency.belief = true;
    options.consistency.look_ahead_seconds = seconds;
    options.index.frame_rate = frame_rate;
    return options;
}

WaitingVerdict verdict_on(std::uint64_t frame, bool may_change)
{
    WaitingVerdict waiting;
    waiting.outcome.verdict.frame = FrameId{frame};
    waiting.may_change = may_change;
    return waiting;
}

/** Numbers of the frames that are due. */
std::vector<std::uint64_t> due(WaitingVerdicts& verdicts)
{
    std::vector<std::uint64_t> frames;
    while (verdicts.oldest_is_due())
        frames.push_back(to_index(verdicts.pop().outcome.verdict.frame));
    return frames;
}

using Frames = std::vector<std::uint64_t>;

TEST(WaitingVerdicts, HoldAFrameUntilOneSoMuchLaterHasCome)
{
    WaitingVerdicts verdicts(looking_ahead(2));
    verdicts.push(verdict_on(0, true), 10);
    EXPECT_TRUE(due(verdicts).empty());
    verdicts.push(verdict_on(1, true), 11.5);
    EXPECT_TRUE(due(verdicts).empty());
    verdicts.push(verdict_on(2, true), 12);
    EXPECT_EQ(due(verdicts), Frames{0});
    verdicts.push(verdict_on(3, true), 20);
    EXPECT_EQ(due(verdicts), (Frames{1, 2}));
}

TEST(WaitingVerdicts, HoldAFrameThatCannotChangeOnlyForItsTurn)
{
    WaitingVerdicts verdicts(looking_ahead(2));
    verdicts.push(verdict_on(0, false), 10);
    EXPECT_EQ(due(verdicts), Frames{0});
    verdicts.push(verdict_on(1, true), 10.5);
    verdicts.push(verdict_on(2, false), 11);
    EXPECT_TRUE(due(verdicts).empty());
    verdicts.push(verdict_on(3, true), 12.5);
    EXPECT_EQ(due(verdicts), (Frames{1, 2}));
    EXPECT_FALSE(verdicts.empty());
}

TEST(WaitingVerdicts, HoldNothingWithoutLookAhead)
{
    WaitingVerdicts verdicts(looking_ahead(0));
    verdicts.push(verdict_on(0, true), 10);
    EXPECT_EQ(due(verdicts), Frames{0});
}

TEST(WaitingVerdicts, HoldNothingForEverWhenTheClockStands)
{
    WaitingVerdicts verdicts(looking_ahead(0.05));  // at most 10 frames
    for (std::uint64_t i = 0; i < 10; ++i)
    {
        verdicts.push(verdict_on(i, true), 7);
        EXPECT_TRUE(due(verdicts).empty()) << i;
    }
    verdicts.push(verdict_on(10, true), 7);
    EXPECT_EQ(due(verdicts), Frames{0});
}

TEST(WaitingVerdicts, CountFramesWhereTheDelayDoes)
{
    WaitingVerdicts verdicts(looking_ahead(0.3, 10));
    for (std::uint64_t i = 0; i < 3; ++i)
    {
        verdicts.push(verdict_on(i, true), 100 * static_cast<double>(i));
        EXPECT_TRUE(due(verdicts).empty()) << i;
    }
    verdicts.push(verdict_on(3, true), 300);
    EXPECT_EQ(due(verdicts), Frames{0});
}

TEST(WaitingVerdicts, CountTheFramesOfEachCamera)
{
    WaitingVerdicts verdicts(looking_ahead(0.3, 10));
    for (std::uint64_t i = 0; i < 7; ++i)
    {
        auto waiting = verdict_on(i, true);
        waiting.outcome.verdict.sensor_label = i % 2 == 0 ? "LEFT" : "RIGHT";
        verdicts.push(std::move(waiting), 0);
        EXPECT_EQ(due(verdicts), i < 6 ? Frames{} : (Frames{0, 1})) << i;
    }
}

}  // namespace
