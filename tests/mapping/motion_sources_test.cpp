// SPDX-License-Identifier: BSD-3-Clause
// What several sources of motion make of the drive through the world of points.
#include "fild/synthetic/geodetic.h"
#include "graph/observations.h"
#include "point_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{
using fild::EastNorthUp;
using fild::Map;
using fild::MapBuilder;
using fild::MotionSourceUse;
using fild::TrajectorySource;
using fild::testing::kFrames;
using fild::testing::map_of;
using fild::testing::PointWorld;
using fild::testing::Recorded;
using mrpt::math::TPoint3D;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kSingle = 1;
constexpr int kRtk = 4;

/** A receiver on the robot, which has a fix just after each frame. */
struct Receiver
{
    std::string label = "GPS";
    int quality = kRtk;
    double noise_m = 0.02;
    TPoint3D offset{};  ///< of all positions
    double clock_s = 0;  ///< ahead of the camera's
    std::function<bool(std::size_t)> has_fix = [](std::size_t) { return true; };
    std::function<bool(std::size_t)> is_wrong = [](std::size_t) { return false; };
    bool is_mirrored = false;  ///< west for east

    void feed(MapBuilder& builder, std::size_t frame) const
    {
        if (!has_fix(frame)) return;
        const TPoint3D antenna(0.5, -0.3, 1.5);
        std::mt19937_64 noise(frame + 7 * label.size() + 1000);
        auto position = PointWorld::map_from_robot(frame).composePoint(antenna) + offset;
        position.x += noise_m * fild::standard_normal(noise) + (is_wrong(frame) ? 8 : 0);
        position.y += noise_m * fild::standard_normal(noise) - (is_wrong(frame) ? 15 : 0);
        position.z += 2 * noise_m * fild::standard_normal(noise);
        const auto place = fild::geodetic_from_map(position);
        auto fix = fild::testing::gps_at(static_cast<double>(frame) + clock_s,
                                         place.latitude_deg,
                                         is_mirrored ? -place.longitude_deg : place.longitude_deg,
                                         place.height_m,
                                         static_cast<std::uint8_t>(quality));
        fix.sensorLabel = label;
        fix.sensorPose = mrpt::poses::CPose3D(antenna.x, antenna.y, antenna.z, 0, 0, 0);
        builder.feed(fix);
    }
};

Recorded with(const std::vector<Receiver>& receivers, bool depth = true, bool odometry = false)
{
    Recorded recorded{depth, odometry, true};
    recorded.feed_more = [receivers](MapBuilder& builder, std::size_t frame)
    {
        for (const auto& receiver : receivers) receiver.feed(builder, frame);
    };
    return recorded;
}

/** Root mean square distance from the truth of poses in a geo-referenced map. */
double error_in_map(const Map& map, const std::vector<fild::TrajectoryPose>& poses)
{
    const EastNorthUp plane(map.origin.value());
    double squares = 0;
    for (const auto& pose : poses)
    {
        const auto& truth = PointWorld::map_from_robot(to_index(pose.frame));
        const auto place = fild::geodetic_from_map({truth.x(), truth.y(), truth.z()});
        const auto& at = pose.map_from_robot;
        squares +=
            std::pow(cv::norm(plane.position_of(place) - cv::Vec3d(at.x(), at.y(), at.z())), 2);
    }
    return std::sqrt(squares / static_cast<double>(poses.size()));
}

const MotionSourceUse& source(const Map& map, const std::string& name)
{
    for (const auto& each : map.sources)
        if (each.name.find(name) != std::string::npos) return each;
    throw std::runtime_error("no source " + name);
}

TEST(MotionSources, KeepWhatRtkKnows)
{
    const auto map = map_of(with({{}}));
    EXPECT_EQ(map.trajectory_source, TrajectorySource::combined);
    EXPECT_EQ(map.optimized.size(), kFrames);
    EXPECT_LT(error_in_map(map, map.trajectory.poses()), 0.05);
    EXPECT_LT(error_in_map(map, map.optimized), 0.05);
    EXPECT_EQ(source(map, "GPS").factors, kFrames);
    EXPECT_EQ(source(map, "GPS").without_weight, 0U);
}

// Relative edges between fixes let go of what GPS knew.
TEST(MotionSources, KeepWhatRtkKnowsOfASingleCamera)
{
    const auto map = map_of(with({{}}, false));
    EXPECT_EQ(map.trajectory_source, TrajectorySource::recorded);
    EXPECT_GT(map.graph.loops.size(), 0U);
    const double before = error_in_map(map, map.trajectory.poses());
    EXPECT_LT(error_in_map(map, map.optimized), std::max(1.05 * before, 0.05));
}

TEST(MotionSources, BridgeGapsOfTheGps)
{
    Receiver receiver;
    receiver.has_fix = [](std::size_t frame) { return frame % 36 < 15 || frame % 36 > 27; };
    const auto map = map_of(with({receiver}));
    EXPECT_EQ(map.optimized.size(), kFrames);
    EXPECT_LT(error_in_map(map, map.optimized), 0.1);
}

TEST(MotionSources, LetGoOfWrongFixes)
{
    Receiver receiver;
    receiver.is_wrong = [](std::size_t frame) { return frame % 5 == 2; };
    const auto map = map_of(with({receiver}));
    EXPECT_LT(error_in_map(map, map.optimized), 0.06);
    EXPECT_EQ(source(map, "GPS").without_weight, kFrames / 5);
}

TEST(MotionSources, AreBetterTogetherThanConsumerGps)
{
    Receiver receiver;
    receiver.quality = kSingle;
    receiver.noise_m = 2;
    const auto map = map_of(with({receiver}));
    EXPECT_LT(error_in_map(map, map.optimized), 1.5) << "each fix is off by 4.9 m";
}

TEST(MotionSources, LeaveOutAReceiverThatLies)
{
    Receiver liar;
    liar.label = "LIAR";
    liar.offset = {20, -10, 0};
    Receiver left;
    left.label = "LEFT";
    left.quality = kSingle;
    left.noise_m = 0.5;
    auto right = left;
    right.label = "RIGHT-1";
    const auto map = map_of(with({liar, left, right}));
    EXPECT_THAT(source(map, "LIAR").left_out, HasSubstr("contradicts other receivers"));
    EXPECT_THAT(source(map, "LEFT").left_out, IsEmpty());
    EXPECT_LT(error_in_map(map, map.optimized), 1);
}

TEST(MotionSources, LeaveOutClocksInAnotherTimeZone)
{
    Receiver receiver;
    receiver.clock_s = 3600;
    const auto map = map_of(with({receiver}));
    EXPECT_THAT(source(map, "GPS").left_out, HasSubstr("3600 s after the first frame"));
    EXPECT_FALSE(map.origin);
    EXPECT_LT(fild::testing::error_of(map.optimized), 0.3);
}

TEST(MotionSources, LeaveOutAnotherHemisphere)
{
    Receiver receiver;
    receiver.is_mirrored = true;
    const auto map = map_of(with({receiver}));
    EXPECT_THAT(source(map, "GPS").left_out, HasSubstr("contradict the robot's motion"));
    EXPECT_LT(fild::testing::error_of(map.optimized), 0.3);
}

TEST(MotionSources, AreChosenAlikeWithoutRobustWeights)
{
    Receiver receiver;
    receiver.noise_m = 3;  // and says 2 cm
    auto recorded = with({receiver});
    recorded.graph.robust_weights = false;
    const auto map = map_of(recorded);
    EXPECT_THAT(source(map, "GPS").left_out, HasSubstr("contradict the robot's motion"));
    EXPECT_LT(fild::testing::error_of(map.optimized), 0.3);
}

TEST(MotionSources, LeaveOutReceiversWithoutAFix)
{
    Receiver receiver;
    receiver.quality = 0;
    const auto map = map_of(with({receiver}));
    EXPECT_THAT(source(map, "GPS").left_out, HasSubstr("has no fix"));
    EXPECT_EQ(map.recorded.front().unusable_readings, kFrames);
    EXPECT_EQ(map.trajectory_source, TrajectorySource::vision);
}

/** Odometry that says so many times the true way. */
Recorded with_odometry_of(double scale)
{
    Recorded recorded{true, false, true};
    recorded.feed_more = [scale](MapBuilder& builder, std::size_t frame)
    {
        mrpt::poses::CPose2D pose;
        for (std::size_t i = 1; i <= frame; ++i)
        {
            const auto step = PointWorld::map_from_robot(i) - PointWorld::map_from_robot(i - 1);
            pose =
                pose + mrpt::poses::CPose2D(
                           scale * step.x(), scale * step.y(), std::min(scale, 1.0) * step.yaw());
        }
        builder.feed(fild::testing::odometry_at(static_cast<double>(frame), pose));
    };
    return recorded;
}

TEST(MotionSources, AreNotWorseWithAnOdometryThatIsOff)
{
    Recorded images_alone;
    images_alone.odometry = false;
    const double alone = fild::testing::error_of(map_of(images_alone).optimized);
    for (const double scale : {1.0, 1.05, 0.95})
    {
        const auto map = map_of(with_odometry_of(scale));
        EXPECT_EQ(map.trajectory_source, TrajectorySource::combined);
        EXPECT_LT(fild::testing::error_of(map.optimized), std::max(1.2 * alone, 0.1)) << scale;
    }
}

TEST(MotionSources, LeaveOutAnOdometryThatStandsStill)
{
    const auto map = map_of(with_odometry_of(0));
    EXPECT_EQ(map.trajectory_source, TrajectorySource::vision);
    EXPECT_THAT(source(map, "WHEELS").left_out, HasSubstr("hardly moves"));
}

/** Beside every second loop a false one, to a place a third of a lap away: a third of all. */
void add_false_loops(MapBuilder& builder, const fild::DetectorOutcome& outcome)
{
    using fild::testing::kFramesPerLap;
    if (!outcome.verdict.accepted() || to_index(outcome.verdict.frame) % 2 == 0) return;
    auto false_loop = outcome;
    auto& candidate = false_loop.verdict.candidate->frame;
    candidate = fild::FrameId{(to_index(candidate) + kFramesPerLap / 3) % kFramesPerLap};
    builder.add(false_loop);
}

// The noise of loops is estimated from the loops themselves, the false ones too.
TEST(MotionSources, AreNotBentByFalseLoops)
{
    Receiver consumer;
    consumer.quality = kSingle;
    consumer.noise_m = 2;
    const std::vector<std::pair<Recorded, double>> drives{
        {with({}), 0.3}, {with({}, true, true), 0.3}, {with({{}}), 0.05}, {with({consumer}), 1.5}};
    for (auto [recorded, limit] : drives)
    {
        recorded.add_more = add_false_loops;
        const auto map = map_of(recorded);
        EXPECT_GE(map.loops.size(), map.graph.loops.size() + 10);
        EXPECT_LT(map.loop_noise_scale, 2);
        const double error =
            map.origin ? error_in_map(map, map.optimized) : fild::testing::error_of(map.optimized);
        EXPECT_LT(error, limit);
    }
}

}  // namespace
