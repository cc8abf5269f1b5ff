// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
TEST(StandardNormal, HasTheMomentsOfTheNormalDistribution)
{
    std::mt19937_64 generator(7);
    constexpr int kSamples = 200000;
    double sum = 0;
    double squares = 0;
    int within_one_sigma = 0;
    for (int i = 0; i < kSamples; ++i)
    {
        const double x = fild::standard_normal(generator);
        ASSERT_TRUE(std::isfinite(x));
        sum += x;
        squares += x * x;
        within_one_sigma += std::abs(x) < 1 ? 1 : 0;
    }
    EXPECT_NEAR(sum / kSamples, 0.0, 0.01);
    EXPECT_NEAR(squares / kSamples, 1.0, 0.02);
    EXPECT_NEAR(static_cast<double>(within_one_sigma) / kSamples, 0.6827, 0.005);
}

TEST(StandardNormal, RepeatsWithTheSeed)
{
    std::mt19937_64 a(1);
    std::mt19937_64 b(1);
    std::mt19937_64 c(2);
    const double first = fild::standard_normal(a);
    EXPECT_EQ(first, fild::standard_normal(b));
    EXPECT_NE(first, fild::standard_normal(c));
}

}  // namespace
