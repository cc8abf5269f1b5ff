// SPDX-License-Identifier: BSD-3-Clause
#include "lane_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using fild::LanePath;
using fild::LanePoint;

constexpr double kPi = 3.141592653589793;

/** Left at (40, 0), right at (40, 50). */
LanePath crooked_path()
{
    return LanePath({{0, 0}, {40, 0}, {40, 50}, {90, 50}}, 9);
}

TEST(LanePath, BeginsAndEndsAtItsEnds)
{
    const auto path = crooked_path();
    EXPECT_EQ(path.at(0).position, cv::Point2d(0, 0));
    EXPECT_EQ(path.at(0).heading, 0);
    const auto end = path.at(path.length());
    EXPECT_NEAR(end.position.x, 90, 1e-6);
    EXPECT_NEAR(end.position.y, 50, 1e-6);
    EXPECT_NEAR(end.heading, 0, 1e-12);
    EXPECT_EQ(path.at(path.length() + 1).position, end.position);
}

TEST(LanePath, TurnsByARightAngleWithinTheReachOfAVertex)
{
    const auto path = crooked_path();
    const auto begin = path.at(path.corner_begin(1));
    const auto end = path.at(path.corner_end(1));
    EXPECT_NEAR(begin.position.x, 31, 1e-6);
    EXPECT_NEAR(begin.position.y, 0, 1e-6);
    EXPECT_NEAR(end.position.x, 40, 1e-6);
    EXPECT_NEAR(end.position.y, 9, 1e-6);
    EXPECT_NEAR(end.heading, kPi / 2, 1e-12);
}

// Finite differences: position moves along the heading at unit speed, heading by the curvature.
TEST(LanePath, MovesAlongItsHeadingWithoutJumps)
{
    const auto path = crooked_path();
    constexpr double kStep = 1e-3;
    for (double s = 0; s + kStep <= path.length(); s += 0.05)
    {
        const auto a = path.at(s);
        const auto b = path.at(s + kStep);
        const auto middle = path.at(s + kStep / 2);
        const auto moved = (b.position - a.position) / kStep;
        EXPECT_NEAR(moved.x, std::cos(middle.heading), 1e-6) << s;
        EXPECT_NEAR(moved.y, std::sin(middle.heading), 1e-6) << s;
        EXPECT_NEAR((b.heading - a.heading) / kStep, middle.curvature, 1e-6) << s;
        EXPECT_NEAR(a.curvature, b.curvature, 2e-4) << s;
        EXPECT_LT(std::abs(a.curvature), 1 / 4.5) << s;
    }
}

TEST(LanePath, RefusesVerticesItCannotJoin)
{
    EXPECT_THROW(LanePath({{0, 0}}, 9), std::invalid_argument);
    EXPECT_THROW(LanePath({{0, 0}, {40, 0}, {80, 40}}, 9), std::invalid_argument);
    EXPECT_THROW(LanePath({{0, 0}, {40, 0}, {40, 15}, {0, 15}}, 9), std::invalid_argument);
    EXPECT_THROW(LanePath({{0, 0}, {0, 0}}, 9), std::invalid_argument);
}

}  // namespace
