// SPDX-License-Identifier: BSD-3-Clause
#include "smooth_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using fild::SmoothNoise;

SmoothNoise noise(double length, double knot_distance, std::uint64_t seed = 1)
{
    return {length, knot_distance, std::mt19937_64(seed)};
}

TEST(SmoothNoise, HasMeanZeroAndDeviationOne)
{
    const auto curve = noise(50000, 10);
    double sum = 0;
    double squares = 0;
    int count = 0;
    for (double s = 0; s <= 50000; s += 3, ++count)
    {
        sum += curve.value(s);
        squares += curve.value(s) * curve.value(s);
        ASSERT_LE(std::abs(curve.value(s)), SmoothNoise::kMaximum);
    }
    EXPECT_NEAR(sum / count, 0, 0.05);
    EXPECT_NEAR(std::sqrt(squares / count), 1, 0.04);
}

TEST(SmoothNoise, HasTheDerivativeOfItsValue)
{
    const auto curve = noise(100, 7);
    constexpr double kStep = 1e-5;
    for (double s = 1; s < 99; s += 0.37)
        EXPECT_NEAR(curve.derivative(s),
                    (curve.value(s + kStep) - curve.value(s - kStep)) / (2 * kStep),
                    1e-6)
            << s;
}

TEST(SmoothNoise, HasNoJumpsAtItsKnots)
{
    const auto curve = noise(100, 10);
    for (double knot = 10; knot < 100; knot += 10)
    {
        EXPECT_NEAR(curve.value(knot - 1e-9), curve.value(knot + 1e-9), 1e-7);
        EXPECT_NEAR(curve.derivative(knot - 1e-9), curve.derivative(knot + 1e-9), 1e-7);
    }
}

TEST(SmoothNoise, IsDefinedUpToItsEndsAndClampedBeyond)
{
    const auto curve = noise(30, 10);
    EXPECT_TRUE(std::isfinite(curve.value(30)));
    EXPECT_EQ(curve.value(-1), curve.value(0));
    EXPECT_EQ(curve.value(31), curve.value(30));
    EXPECT_TRUE(std::isfinite(noise(0, 10).value(0)));
}

TEST(SmoothNoise, DependsOnTheGenerator)
{
    EXPECT_EQ(noise(10, 1).value(5), noise(10, 1).value(5));
    EXPECT_NE(noise(10, 1).value(5), noise(10, 1, 2).value(5));
}

TEST(SmoothNoise, RefusesImpossibleLengths)
{
    EXPECT_THROW(noise(-1, 1), std::invalid_argument);
    EXPECT_THROW(noise(1, 0), std::invalid_argument);
    EXPECT_THROW(noise(std::numeric_limits<double>::quiet_NaN(), 1), std::invalid_argument);
}

}  // namespace
