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
    EXPECT_EQ(map.trajectory_source, TrajectorySource::combined);
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
    for (const auto& loop : map.loops) EXPECT_TRUE(loop.unscaled.has_value());
    EXPECT_TRUE(map.graph.nodes.empty());
    EXPECT_TRUE(map.optimized.empty());
}

TEST(MapBuilder, EndsWhenItIsToldTo)
{
    const auto stop = [] { throw std::runtime_error("enough"); };
    for (const bool odometry : {true, false})
    {
        Recorded recorded;
        recorded.odometry = odometry;
        EXPECT_THROW(map_of(
                         2, recorded, detector_options(), [](FrameDescription&) {}, stop),
                     std::runtime_error);
    }
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

TEST(MapBuilder, GoesOnWhereNearThingsAreFew)
{
    Recorded recorded;
    recorded.odometry = false;
    constexpr std::size_t kNear = 3;  // too few for a pose
    const auto map = map_of(kFrames,
                            recorded,
                            detector_options(),
                            [](FrameDescription& frame)
                            {
                                const auto i = to_index(frame.frame);
                                if (i < 8 || i > 10) return;
                                auto& depths = frame.metric.depths.metres;
                                std::fill(depths.begin() + kNear, depths.end(), std::nanf(""));
                            });
    EXPECT_EQ(map.trajectory.report().resets, 0U);
    EXPECT_EQ(map.graph.nodes.size(), kFrames);
    EXPECT_EQ(map.graph.odometry.size(), kFrames - 1);
    EXPECT_LT(error_of(map.optimized), 0.3);
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

/** The same world, seen by a robot whose camera is said to be where `change` says. */
template <class Change>
fild::MotionAgreement agreement_of(const Recorded& recorded, Change&& change)
{
    return map_of(kFramesPerLap, recorded, detector_options(), change).agreement;
}

TEST(MapBuilder, FindsThatCameraAndOdometryAgree)
{
    for (const bool depth : {true, false})
    {
        const auto agreement = agreement_of({depth, true, true}, [](FrameDescription&) {});
        EXPECT_GE(agreement.direction_error_deg.count, 20U);
        EXPECT_LT(agreement.direction_error_deg.upper, 15);
        EXPECT_FALSE(agreement.contradicts_directions());
        EXPECT_FALSE(agreement.contradicts_lengths());
        EXPECT_EQ(agreement.length_ratio.count > 0, depth);
    }
}

TEST(MapBuilder, FindsThatTheCamerasPoseLacksTheTurnToItsAxes)
{
    const auto forget_the_turn = [](FrameDescription& frame) {
        frame.metric.robot_from_camera = fild::RigidTransform{cv::Matx33d::eye(), {0.4, 0.1, 1}};
    };
    for (const bool depth : {true, false})
    {
        const auto agreement = agreement_of({depth, true, true}, forget_the_turn);
        EXPECT_TRUE(agreement.contradicts_directions()) << depth;
        EXPECT_TRUE(agreement.lacks_turn()) << depth;
    }
    const auto look_left = [](FrameDescription& frame) {
        frame.metric.robot_from_camera = fild::rigid_transform_from({0.4, 0.1, 1, 0, 0, -M_PI / 2});
    };
    const auto agreement = agreement_of({true, true, true}, look_left);
    EXPECT_TRUE(agreement.contradicts_directions());
    EXPECT_FALSE(agreement.lacks_turn());
}

TEST(MapBuilder, FindsThatDepthsAndOdometryHaveOtherUnits)
{
    for (const float factor : {0.2F, 5.0F, 50.0F, 500.0F})
    {
        const auto agreement = agreement_of({true, true, true},
                                            [&](FrameDescription& frame)
                                            {
                                                for (auto& z : frame.metric.depths.metres)
                                                    z *= factor;
                                                for (auto& s : frame.metric.depths.deviations_m)
                                                    s *= factor;
                                            });
        EXPECT_TRUE(agreement.contradicts_lengths()) << factor;
        EXPECT_NEAR(agreement.length_ratio.median / static_cast<double>(factor), 1, 0.1);
        EXPECT_FALSE(agreement.contradicts_directions());
    }
}

TEST(MapBuilder, HasOneEdgeForAllLoopsOfARobotThatStands)
{
    const PointWorld world;
    auto options = detector_options();
    options.index.still_seconds = 2;
    fild::PlaceMap places;
    fild::LoopDetector detector(options, fild::testing::kDescriptorLength, places);
    const fild::LoopPoses poses(options);
    fild::MapBuilder builder(options, fild::TGraphOptions());
    fild::StageTimes times;
    constexpr std::size_t kStop = kFramesPerLap + 5;  // on the second lap
    constexpr std::size_t kStays = 15;
    for (std::size_t i = 0; i < kStop + kStays; ++i)
    {
        const auto where = std::min(i, kStop);
        auto odometry = fild::testing::drifting_odometry(where);
        odometry.timestamp = mrpt::Clock::fromDouble(static_cast<double>(i));
        builder.feed(odometry);
        auto seen = world.describe(where, {});
        seen.frame = fild::FrameId{i};
        seen.timestamp = static_cast<double>(i);
        builder.add_frame(seen.frame, seen.timestamp);
        auto outcome = detector.process(std::move(seen), times).front();
        poses.add_pose(outcome, places, times);
        builder.add(outcome);
    }
    const auto map = builder.build(places, times);
    constexpr std::size_t kBeforeItCounts = 2;  // frames
    EXPECT_GE(map.loops.size(), kStays);
    EXPECT_EQ(withheld(map, Withheld::stood_still), kStays - kBeforeItCounts);
    EXPECT_LE(map.graph.nodes.size(), kStop + 1 + kBeforeItCounts + 1) << "and the last frame";
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
