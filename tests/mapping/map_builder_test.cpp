// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/map_builder.h"

#include "point_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
using fild::DepthDefect;
using fild::FrameDescription;
using fild::Map;
using fild::TrajectorySource;
using fild::Withheld;
using fild::testing::detector_options;
using fild::testing::error_of;
using fild::testing::kFrames;
using fild::testing::kFramesPerLap;
using fild::testing::map_of;
using fild::testing::PointWorld;
using fild::testing::Recorded;

std::size_t withheld(const Map& map, Withheld reason)
{
    return static_cast<std::size_t>(std::count_if(map.loops.begin(),
                                                  map.loops.end(),
                                                  [&](const auto& loop)
                                                  { return loop.withheld == reason; }));
}

/** Median distance of the loops' motions from the truth. */
double median_edge_error(const Map& map)
{
    std::vector<double> errors;
    for (const auto& loop : map.loops)
    {
        if (!loop.motion) continue;
        const auto truth = PointWorld::map_from_robot(to_index(loop.query)) -
                           PointWorld::map_from_robot(to_index(loop.candidate));
        errors.push_back(loop.motion->a_from_b.distanceTo(truth));
    }
    std::sort(errors.begin(), errors.end());
    return errors.empty() ? std::nan("") : errors[errors.size() / 2];
}

/** A frame that shows nothing. */
void darken(FrameDescription& frame)
{
    frame.local.positions.clear();
    frame.local.codes.words.clear();
    frame.metric.depths.metres.clear();
    frame.metric.depths.deviations_m.clear();
}

TEST(MapBuilder, ClosesTheLoopsOfADriftingOdometry)
{
    const auto map = map_of(Recorded{});
    EXPECT_EQ(map.trajectory_source, TrajectorySource::recorded);
    ASSERT_GE(map.loops.size(), kFramesPerLap - 1);
    EXPECT_EQ(withheld(map, Withheld::none), map.loops.size());
    EXPECT_LT(median_edge_error(map), 0.05);
    EXPECT_EQ(map.graph.loops.size(), map.loops.size());
    EXPECT_EQ(map.optimized.size(), kFrames);
    EXPECT_EQ(map.parts.size(), 1U);
    EXPECT_LT(map.chi2_after, map.chi2_before);
    EXPECT_LT(error_of(map.optimized), 0.7 * error_of(map.trajectory.poses()));
    EXPECT_TRUE(map.frames_with_motion_depth.empty());
}

TEST(MapBuilder, NeedsNoOdometryWhereThereIsDepth)
{
    Recorded recorded;
    recorded.odometry = false;
    const auto map = map_of(recorded);
    EXPECT_EQ(map.trajectory_source, TrajectorySource::vision);
    EXPECT_EQ(map.graph.nodes.size(), kFrames);
    EXPECT_EQ(map.graph.odometry.size(), kFrames - 1);
    EXPECT_EQ(map.parts.size(), 1U);
    EXPECT_GE(map.graph.loops.size(), kFramesPerLap - 1);
    EXPECT_LT(error_of(map.optimized), 0.3);
}

TEST(MapBuilder, ScalesASingleCameraByTheOdometry)
{
    Recorded recorded;
    recorded.depth = false;
    const auto map = map_of(recorded);
    ASSERT_GE(map.loops.size(), kFramesPerLap - 1);
    EXPECT_GE(withheld(map, Withheld::none), map.loops.size() * 9 / 10);
    EXPECT_FALSE(map.frames_with_motion_depth.empty());
    EXPECT_LT(median_edge_error(map), 0.1);  // the odometry's scale is off by 2 %
    EXPECT_LT(error_of(map.optimized), 0.7 * error_of(map.trajectory.poses()));
}

TEST(MapBuilder, WithholdsEdgesOfASingleCameraWithoutOdometry)
{
    Recorded recorded;
    recorded.depth = recorded.odometry = false;
    const auto map = map_of(recorded);
    EXPECT_EQ(map.trajectory_source, TrajectorySource::none);
    EXPECT_GE(map.loops.size(), kFramesPerLap - 1);
    EXPECT_EQ(withheld(map, Withheld::no_odometry), map.loops.size());
    EXPECT_TRUE(map.graph.nodes.empty());
    EXPECT_TRUE(map.optimized.empty());
}

TEST(MapBuilder, WithholdsEdgesOfCamerasWithoutCalibration)
{
    Recorded recorded;
    recorded.calibration = false;
    recorded.depth = false;
    const auto map = map_of(recorded);
    EXPECT_EQ(withheld(map, Withheld::not_calibrated), map.loops.size());
    EXPECT_EQ(map.graph.nodes.size(), kFrames) << "the odometry is there all the same";
    const auto distorted =
        map_of(kFrames,
               recorded,
               detector_options(),
               [](FrameDescription& frame) { frame.metric.depth_defect = DepthDefect::distorted; });
    EXPECT_EQ(withheld(distorted, Withheld::distorted), map.loops.size());
}

TEST(MapBuilder, MakesNoPosesWhenNotAskedTo)
{
    auto options = detector_options();
    options.relative_pose.enabled = false;
    const auto map = map_of({}, options);
    EXPECT_EQ(withheld(map, Withheld::not_enabled), map.loops.size());
    EXPECT_EQ(map.graph.odometry.size(), kFrames - 1);
}

TEST(MapBuilder, GoesOnBehindAFrameThatShowsNothing)
{
    Recorded recorded;
    recorded.odometry = false;
    const auto map = map_of(kFrames,
                            recorded,
                            detector_options(),
                            [](FrameDescription& frame)
                            {
                                if (to_index(frame.frame) == 5) darken(frame);
                            });
    EXPECT_EQ(map.trajectory.report().resets, 0U);
    EXPECT_EQ(map.graph.nodes.size(), kFrames - 1);
    EXPECT_EQ(map.parts.size(), 1U);
}

// A third of the first lap is dark: the second lap's loops hold the parts together, or not.
TEST(MapBuilder, TellsThePartsOfAMapThatFallsApart)
{
    Recorded recorded;
    recorded.odometry = false;
    const auto in_the_dark = [](FrameDescription& frame)
    {
        if (to_index(frame.frame) >= 10 && to_index(frame.frame) <= 22) darken(frame);
    };
    auto without_loops = detector_options();
    without_loops.index.delay_seconds = kFrames;
    const auto one_lap = map_of(kFramesPerLap, recorded, without_loops, in_the_dark);
    EXPECT_EQ(one_lap.trajectory.report().resets, 1U);
    ASSERT_EQ(one_lap.parts.size(), 2U);
    EXPECT_EQ(one_lap.parts[0].size() + one_lap.parts[1].size(), one_lap.graph.nodes.size());
    const auto two_laps = map_of(kFrames, recorded, detector_options(), in_the_dark);
    EXPECT_EQ(two_laps.parts.size(), 1U);
    EXPECT_LT(error_of(two_laps.optimized), 0.5);
}

TEST(MapBuilder, MakesAMapOfOneFrameAndOfNone)
{
    const auto nothing = [](FrameDescription&) {};
    const auto one = map_of(1, {}, detector_options(), nothing);
    EXPECT_EQ(one.graph.nodes.size(), 1U);
    EXPECT_EQ(one.optimizations, 0);
    const auto one_without_odometry = map_of(1, {true, false, true}, detector_options(), nothing);
    EXPECT_TRUE(one_without_odometry.graph.nodes.empty());
    EXPECT_TRUE(map_of(0, {}, detector_options(), nothing).graph.nodes.empty());
    EXPECT_TRUE(map_of(0, {true, false, true}, detector_options(), nothing).graph.nodes.empty());
}

TEST(MapBuilder, GivesTheSameMapWithAnyNumberOfThreads)
{
    constexpr std::size_t kSomeLoops = kFramesPerLap + 8;
    for (const auto& recorded : {Recorded{true, false, true}, Recorded{false, true, true}})
    {
        auto options = detector_options();
        const auto nothing = [](FrameDescription&) {};
        const auto one = map_of(kSomeLoops, recorded, options, nothing);
        options.runtime.num_threads = 3;
        const auto three = map_of(kSomeLoops, recorded, options, nothing);
        ASSERT_EQ(one.optimized.size(), three.optimized.size());
        for (std::size_t i = 0; i < one.optimized.size(); ++i)
            EXPECT_EQ(one.optimized[i].map_from_robot, three.optimized[i].map_from_robot);
        EXPECT_GT(one.graph.loops.size(), 0U);
        EXPECT_EQ(one.chi2_after, three.chi2_after);
    }
}

}  // namespace
