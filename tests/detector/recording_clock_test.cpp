// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/recording_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace
{
using fild::RecordingClock;
using ::testing::ElementsAre;

constexpr double kStep = 0.1;  // s
constexpr double kStart = 1.7e9;

/** Frames of one camera at 10 Hz; `shift` is added to the stamp of frame i. \return the time of
 *  each frame. */
template <class Shift>
std::vector<double> times_of(std::size_t frames, Shift&& shift, std::size_t jumps)
{
    RecordingClock clock;
    std::vector<double> times;
    for (std::size_t i = 0; i < frames; ++i)
        times.push_back(clock.advance("LEFT", kStart + kStep * static_cast<double>(i) + shift(i)));
    EXPECT_EQ(clock.jumps(), jumps);
    return times;
}

/** Never back, and at no time further ahead of the true time than `ahead`, or behind by more than
 *  `behind` at the end. */
void expect_true_times(const std::vector<double>& times, double ahead, double behind)
{
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        EXPECT_GE(times[i], times[i - std::min<std::size_t>(i, 1)]) << i;
        EXPECT_LE(times[i], kStep * static_cast<double>(i) + ahead + 1e-6) << i;
    }
    EXPECT_GE(times.back(), kStep * static_cast<double>(times.size() - 1) - behind - 1e-6);
}

TEST(RecordingClock, FollowsStampsThatRunWell)
{
    expect_true_times(times_of(
                          500, [](std::size_t) { return 0; }, 0),
                      0,
                      0);
}

TEST(RecordingClock, PassesOverASingleWrongStamp)
{
    for (const double shift : {-60.0, 60.0, -kStart, 1e12})
    {
        const auto glitch = [&](std::size_t i) { return i == 200 ? shift : 0; };
        const auto times = times_of(500, glitch, 1);
        expect_true_times(times, 0, 0);
        EXPECT_EQ(times[200], times[199]);
        EXPECT_NEAR(times[201], 20.1, 1e-6) << "goes on as if nothing had been";
    }
}

TEST(RecordingClock, PassesOverStampsThatAreNoNumbers)
{
    const auto nan = [](std::size_t i)
    {
        if (i % 7 == 3) return std::numeric_limits<double>::quiet_NaN();
        return i % 7 == 5 ? std::numeric_limits<double>::infinity() : 0;
    };
    expect_true_times(times_of(500, nan, 0), 0, kStep);
}

TEST(RecordingClock, GoesOnAfterAClockThatWasSet)
{
    for (const double shift : {-3600.0, 3600.0, 1e9})
    {
        const auto set = [&](std::size_t i) { return i >= 200 ? shift : 0; };
        const auto times = times_of(500, set, 1);
        expect_true_times(times, 0, 0);
        EXPECT_EQ(times[205], times[199]) << "might be a glitch yet";
        EXPECT_NEAR(times[211], 21.1, 1e-6);
    }
}

TEST(RecordingClock, GoesOnWhenTheClockIsSetBackAndReturns)
{
    const auto back_for_a_while = [](std::size_t i) { return i >= 200 && i < 300 ? -60.0 : 0.0; };
    expect_true_times(times_of(500, back_for_a_while, 2), 0, 0);
    const auto back_for_a_moment = [](std::size_t i) { return i >= 200 && i < 205 ? -60.0 : 0.0; };
    expect_true_times(times_of(500, back_for_a_moment, 1), 0, 0);
}

TEST(RecordingClock, TakesAPauseForOneStep)
{
    const auto times = times_of(
        500, [](std::size_t i) { return i >= 200 ? 300.0 : 0.0; }, 1);
    expect_true_times(times, 0, 0);
}

TEST(RecordingClock, TakesFramesThatAreLeftOutInFull)
{
    const auto times = times_of(
        500, [](std::size_t i) { return i >= 200 ? 4.0 : 0.0; }, 0);
    EXPECT_NEAR(times.back(), 49.9 + 4, 1e-6);
}

TEST(RecordingClock, BearsStampsOutOfOrder)
{
    const auto swapped = [](std::size_t i) { return i % 2 == 0 ? 0.15 : 0.0; };
    expect_true_times(times_of(500, swapped, 0), 0.0, 0.15);
}

TEST(RecordingClock, DoesNotCountAClockSetBackByLessThanASecond)
{
    const auto times = times_of(
        500, [](std::size_t i) { return i >= 200 ? -0.5 : 0.0; }, 0);
    expect_true_times(times, 0, 0.5);
}

TEST(RecordingClock, IsNotMisledByTwoClocksInTurns)
{
    for (const double other : {-990.0, 990.0})
    {
        RecordingClock clock;
        double time = 0;
        for (int i = 0; i < 500; ++i)
            time = clock.advance("LEFT", kStart + kStep * i + (i % 2 == 1 ? other : 0));
        EXPECT_NEAR(time, 49.8, 1e-6);
    }
}

TEST(RecordingClock, HasOneTimelineForCamerasThatInterleave)
{
    RecordingClock clock;
    double time = 0;
    for (int i = 0; i < 300; ++i)
    {
        time = clock.advance("LEFT", kStart + kStep * i);
        EXPECT_EQ(clock.advance("RIGHT", kStart + kStep * i - 0.05), time);
    }
    EXPECT_NEAR(time, 29.9, 1e-6);
    EXPECT_EQ(clock.jumps(), 0U);
}

TEST(RecordingClock, BearsCamerasWithClocksOfTheirOwn)
{
    RecordingClock clock;
    double time = 0;
    for (int i = 0; i < 300; ++i)
    {
        clock.advance("LEFT", kStart + kStep * i);
        time = clock.advance("RIGHT", 12 + kStep * i + (i >= 100 ? 500 : 0));
    }
    EXPECT_NEAR(time, 29.9, 0.1 + 1e-6);
    EXPECT_EQ(clock.jumps(), 1U) << "of RIGHT alone";
}

TEST(RecordingClock, GoesOnWithTheCameraThatRemains)
{
    RecordingClock clock;
    for (int i = 0; i < 100; ++i)
    {
        clock.advance("LEFT", kStep * i);
        clock.advance("RIGHT", kStep * i);
    }
    for (int i = 100; i < 2000; ++i) clock.advance("LEFT", kStep * i);
    EXPECT_NEAR(clock.advance("RIGHT", 200), 200, 1e-6) << "a pause of one camera is seen as such";
    EXPECT_EQ(clock.jumps(), 0U);
}

TEST(RecordingClock, LearnsASlowFrameRate)
{
    RecordingClock clock;
    std::vector<double> times;
    for (int i = 0; i < 6; ++i) times.push_back(clock.advance("LEFT", 100 + 60 * i));
    EXPECT_THAT(times, ElementsAre(0, 0, 120, 180, 240, 300));
    EXPECT_EQ(clock.jumps(), 0U);
}

TEST(RecordingClock, IsNotMisledByAFirstStampThatIsWrong)
{
    const auto times = times_of(
        500, [](std::size_t i) { return i == 0 ? -kStart : 0.0; }, 0);
    expect_true_times(times, 0, 0);
    RecordingClock slow;
    for (const double stamp : {0.0, kStart, kStart + 1, kStart + 2}) slow.advance("LEFT", stamp);
    EXPECT_NEAR(slow.advance("LEFT", kStart + 3), 4, 1e-6);
}

TEST(RecordingClock, StandsStillWithoutStamps)
{
    RecordingClock clock;
    for (int i = 0; i < 100; ++i) EXPECT_EQ(clock.advance("LEFT", 0), 0);
}

}  // namespace
