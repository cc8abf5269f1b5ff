// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/metric.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace
{
const fild::Metric& find(const std::vector<fild::Metric>& metrics, const std::string& key)
{
    for (const auto& metric : metrics)
        if (metric.key == key) return metric;
    throw std::out_of_range(key);
}

TEST(Metrics, HaveDifferentKeys)
{
    fild::RunEvaluation run;
    run.similarity_curve.kind = fild::ScoreKind::similarity;
    fild::TrajectoryError error;
    error.steps = {{10, 1, 2, 3, 4}, {100, 1, 2, 3, 4}};
    run.trajectories = {{"input", error}, {"mine", error}};
    std::set<std::string> keys;
    for (const auto& metric : fild::metrics_of(run))
        EXPECT_TRUE(keys.insert(metric.key).second) << metric.key;
    EXPECT_EQ(keys.count("rpe_mine_100m_deg_per_m"), 1U);
}

TEST(Metrics, AreUnknownWithoutTheirFile)
{
    const auto metrics = fild::metrics_of({});
    for (const std::string key : {"candidate_recall_5", "lost_geometry", "ate_optimized_m"})
    {
        EXPECT_FALSE(find(metrics, key).value) << key;
        EXPECT_TRUE(find(metrics, key).left_out_without_value) << key;
    }
    EXPECT_FALSE(find(metrics, "recall").value);
    EXPECT_FALSE(find(metrics, "recall").left_out_without_value);
}

TEST(Metrics, CountLostLoopsByStage)
{
    fild::RunEvaluation run;
    run.candidates.emplace();
    run.candidates->lost = {{fild::FrameId{1}, fild::LossStage::matching},
                            {fild::FrameId{2}, fild::LossStage::matching},
                            {fild::FrameId{3}, fild::LossStage::choice}};
    const auto metrics = fild::metrics_of(run);
    EXPECT_EQ(find(metrics, "lost_matching").value, 2);
    EXPECT_EQ(find(metrics, "lost_choice").value, 1);
    EXPECT_EQ(find(metrics, "lost_frame").value, 0);
}

TEST(Ranges, AreOverTheRunsThatHaveTheMetric)
{
    const auto run = [](std::optional<double> recall) -> std::vector<fild::Metric> {
        return {{"", "recall", "recall", "", fild::Metric::Kind::share, recall, false}};
    };
    const auto ranges = fild::ranges_of({run(0.5), run(std::nullopt), run(0.9), run(0.1)});
    ASSERT_EQ(ranges.size(), 1U);
    EXPECT_EQ(ranges[0].runs, 3U);
    EXPECT_NEAR(ranges[0].metric.value.value(), 0.5, 1e-12);
    EXPECT_DOUBLE_EQ(ranges[0].min, 0.1);
    EXPECT_DOUBLE_EQ(ranges[0].max, 0.9);
    EXPECT_FALSE(fild::ranges_of({run(std::nullopt)})[0].metric.value);
}

}  // namespace
