// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/stage_times.h"

#include <gtest/gtest.h>

namespace
{
TEST(StageTimes, GivesNearestRankStatistics)
{
    fild::StageTimes times;
    for (int i = 100; i >= 1; --i) times.add("search", i);
    times.add("other", 7);
    const auto statistics = times.statistics();
    ASSERT_EQ(statistics.size(), 2U);
    const auto& search = statistics.at("search");
    EXPECT_EQ(search.calls, 100U);
    EXPECT_DOUBLE_EQ(search.mean_ms, 50.5);
    EXPECT_DOUBLE_EQ(search.median_ms, 50);
    EXPECT_DOUBLE_EQ(search.p95_ms, 95);
    EXPECT_DOUBLE_EQ(search.max_ms, 100);
    EXPECT_DOUBLE_EQ(statistics.at("other").median_ms, 7);
}

TEST(StageTimes, MergesTheCallsOfAnother)
{
    fild::StageTimes a;
    fild::StageTimes b;
    a.add("search", 1);
    b.add("search", 3);
    b.add("other", 5);
    a.merge(b);
    EXPECT_DOUBLE_EQ(a.statistics().at("search").mean_ms, 2);
    EXPECT_EQ(a.statistics().at("other").calls, 1U);
    EXPECT_DOUBLE_EQ(a.total_ms("search"), 4);
}

TEST(StageTimes, IsEmptyWithoutCalls)
{
    EXPECT_TRUE(fild::StageTimes().statistics().empty());
    EXPECT_EQ(fild::StageTimes().total_ms("search"), 0);
}

TEST(StageTimer, AddsOneCallPerScope)
{
    fild::StageTimes times;
    {
        const fild::StageTimer timer(times, "scope");
    }
    EXPECT_EQ(times.statistics().at("scope").calls, 1U);
}

}  // namespace
