// SPDX-License-Identifier: BSD-3-Clause
#include "gps_priors.h"

#include "fild/core/cancellation.h"
#include "motion_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace
{
using fild::FrameId;
using fild::GpsTrack;
using fild::Trajectory;

constexpr double kSpeed = 1;  // m/s
constexpr double kMaxGap = 2;  // s

/** Drives along x, ten images a second by each camera. */
Trajectory slow_drive(std::size_t seconds, std::size_t cameras)
{
    std::vector<Trajectory::Frame> frames;
    for (std::size_t i = 0; i <= 10 * seconds; ++i)
        for (std::size_t camera = 0; camera < cameras; ++camera)
        {
            Trajectory::Frame frame{FrameId{frames.size()}, 0.1 * static_cast<double>(i), {}};
            frame.at.map_from_robot.translation = {kSpeed * frame.timestamp, 0, 0};
            frames.push_back(frame);
        }
    return {std::move(frames), {}};
}

/** A fix a second, `late` seconds after the first image of each. */
GpsTrack fixes_of(const Trajectory& motion, std::size_t seconds, double late)
{
    GpsTrack track;
    for (std::size_t i = 0; i < seconds; ++i)
    {
        const double time = static_cast<double>(i) + late;
        track.positions.push_back({time, {kSpeed * time, 0, 0}, 0.02, {0, 0, 0}});
    }
    track.runs = {{0, track.positions.size()}};
    for (const auto& frame : motion.frames()) track.frames.push_back({frame.id, frame.timestamp});
    return track;
}

void expect_all_are_used(std::size_t cameras, double late)
{
    SCOPED_TRACE(late);
    constexpr std::size_t kSeconds = 20;
    const auto motion = slow_drive(kSeconds, cameras);
    std::set<FrameId> keyframes;  // one a second
    for (std::size_t i = 0; i <= kSeconds; ++i) keyframes.insert(FrameId{10 * cameras * i});
    const auto priors = priors_of(fixes_of(motion, kSeconds, late), motion, keyframes, kMaxGap, 1);
    ASSERT_EQ(priors.size(), kSeconds);
    for (const auto& prior : priors)
    {
        const double keyframe = motion.frames()[to_index(prior.frame)].timestamp;
        EXPECT_NEAR(keyframe * kSpeed + prior.robot_from_point.x, prior.map_from_point.x, 1e-9);
    }
}

// Keyframes of a slow robot are many images apart.
TEST(GpsPriors, UseFixesBetweenKeyframes)
{
    for (const double late : {0.0, 0.05, 0.3, 0.45, 0.7}) expect_all_are_used(1, late);
}

TEST(GpsPriors, UseFixesBesideASecondCamera)
{
    for (const double late : {0.0, 0.05, 0.3, 0.7}) expect_all_are_used(2, late);
}

TEST(GpsPriors, LeaveOutFixesThatNoKeyframeIsNear)
{
    const auto motion = slow_drive(20, 1);
    EXPECT_TRUE(priors_of(fixes_of(motion, 20, 100), motion, {FrameId{0}}, kMaxGap, 1).empty());
    EXPECT_EQ(priors_of(fixes_of(motion, 20, 0.5), motion, {FrameId{0}}, kMaxGap, 1).size(), 1U);
}

// Where frames stand exactly as far apart as keyframes must, rounding decides, and a way that is
// turned into the map has other keyframes.
TEST(MotionEstimate, KeepsFixesOfFramesThatAreNoKeyframesInTheMap)
{
    constexpr std::size_t kFrames = 40;
    std::vector<Trajectory::Frame> frames;
    fild::GpsRecord gps;
    gps.tracks.emplace_back();
    auto& track = gps.tracks.back();
    for (std::size_t i = 0; i < kFrames; ++i)
    {
        const auto metres = static_cast<double>(i);
        Trajectory::Frame frame{FrameId{i}, metres, {}};
        frame.at.map_from_robot.translation = {metres, 0, 0};
        frames.push_back(frame);
        track.frames.push_back({frame.id, frame.timestamp});
        track.positions.push_back(
            {frame.timestamp, {metres * std::cos(0.5), metres * std::sin(0.5), 0}, 0.02, {}});
    }
    track.runs = {{0, kFrames}};
    fild::TGraphOptions options;
    options.keyframe_distance_m = 1;
    const auto estimate = fild::estimate_motion(
        {std::move(frames), {}}, {{}, {}}, gps, options, fild::never_cancelled);
    ASSERT_EQ(estimate.way.poses().size(), kFrames);
    const auto end = estimate.way.poses().back().map_from_robot;
    EXPECT_NEAR(end.x(), (kFrames - 1) * std::cos(0.5), 0.1);
    EXPECT_NEAR(end.y(), (kFrames - 1) * std::sin(0.5), 0.1);
}
}  // namespace
