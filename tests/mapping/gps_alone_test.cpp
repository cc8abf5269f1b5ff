// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/motion_recorder.h"
#include "fild/synthetic/geodetic.h"
#include "graph/observations.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using fild::FrameId;
using fild::MotionRecorder;
using fild::testing::gps_at;
using fild::testing::odometry_at;
using mrpt::poses::CPose2D;

mrpt::obs::CObservationGPS gps_on_map(double seconds, double east, double north)
{
    const auto place = fild::geodetic_from_map({east, north, 0});
    return gps_at(seconds, place.latitude_deg, place.longitude_deg, place.height_m);
}

TEST(GpsAlone, GpsGivesPositionsAndTheHeadingOfTheMovement)
{
    MotionRecorder recorder({});
    recorder.feed(odometry_at(0, CPose2D(9, 9, 9)));
    std::uint64_t frame = 0;
    for (int i = 0; i < 60; ++i)  // 30 m to the east, then north
    {
        recorder.feed(gps_on_map(i, std::min(i, 30), std::max(0, i - 30)));
        recorder.add_frame(FrameId{frame++}, i);
    }
    recorder.feed(gps_at(60, 0, 0, 0, 0));  // no fix
    const auto trajectory = recorder.gps_alone();
    EXPECT_EQ(trajectory.report().source, "CObservationGPS 'GPS'");
    EXPECT_EQ(trajectory.report().unusable_readings, 1U);
    const auto east = trajectory.pose(FrameId{15})->map_from_robot;
    EXPECT_NEAR(east.x(), 15, 0.01);
    EXPECT_NEAR(east.yaw(), 0, 1e-3);
    const auto north = trajectory.pose(FrameId{50})->map_from_robot;
    EXPECT_NEAR(north.x(), 30, 0.01);
    EXPECT_NEAR(north.y(), 20, 0.01);
    EXPECT_NEAR(north.yaw(), M_PI / 2, 1e-3);
    EXPECT_NEAR(trajectory.pose(FrameId{0})->map_from_robot.yaw(), 0, 1e-3);
    const auto motion = trajectory.motion(FrameId{15}, FrameId{50});
    EXPECT_NEAR(motion->covariance(0, 0), 2 * 4, 0.1) << "both fixes are off by gps_sigma_m";
}

/** Along a straight street with a fix each second; some are moved. */
template <class Move>
fild::Trajectory drive_by_gps(int seconds, Move&& move)
{
    MotionRecorder recorder({});
    for (int i = 0; i < seconds; ++i)
    {
        recorder.feed(gps_on_map(i, 10.0 * i + move(i), 0));
        recorder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    return recorder.gps_alone();
}

TEST(GpsAlone, LeavesOutFixesThatTheRobotIsTooSlowFor)
{
    for (const int first : {0, 5})  // at the very beginning, too
    {
        const auto trajectory =
            drive_by_gps(60, [&](int i) { return i % 10 == first ? 555.0 : 0.0; });
        EXPECT_EQ(trajectory.report().implausible_readings, 6U);
        EXPECT_EQ(trajectory.report().readings, 54U);
        const auto begin = trajectory.pose(FrameId{1})->map_from_robot;
        for (const std::uint64_t i : {9U, 15U, 25U, 50U})
        {
            const auto pose = trajectory.pose(FrameId{i});
            ASSERT_TRUE(pose) << i;
            EXPECT_NEAR(
                pose->map_from_robot.x() - begin.x(), 10.0 * static_cast<double>(i - 1), 0.1)
                << i;
        }
    }
}

TEST(GpsAlone, PlacesTheMapAtTheFirstPlausibleFix)
{
    MotionRecorder recorder({});
    recorder.feed(gps_at(0, 1, 1, 0));  // off the coast of Africa, with a fix
    for (int i = 1; i < 20; ++i)
    {
        recorder.feed(gps_on_map(i, 10.0 * i, 0));
        recorder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto trajectory = recorder.gps_alone();
    EXPECT_EQ(trajectory.report().implausible_readings, 1U);
    EXPECT_NEAR(trajectory.pose(FrameId{1})->map_from_robot.x(), 0, 1e-6);
    EXPECT_NEAR(trajectory.pose(FrameId{19})->map_from_robot.x(), 180, 0.1);
}

TEST(GpsAlone, GoesOnWhereAllFixesMoveForGood)
{
    const auto trajectory = drive_by_gps(60, [](int i) { return i < 40 ? 0.0 : 300.0; });
    EXPECT_EQ(trajectory.report().implausible_readings, 0U);
    const auto noisy = drive_by_gps(60, [](int i) { return i % 2 == 0 ? 8.0 : -8.0; });
    EXPECT_EQ(noisy.report().implausible_readings, 0U) << "as uncertain as they say";
}

TEST(GpsAlone, CountsGpsWithoutGga)
{
    MotionRecorder recorder({});
    mrpt::obs::CObservationGPS rmc;
    rmc.timestamp = mrpt::Clock::fromDouble(0);
    rmc.sensorLabel = "GPS";
    rmc.setMsg(mrpt::obs::gnss::Message_NMEA_RMC());
    recorder.feed(rmc);
    recorder.feed(gps_at(1, 0, 0, 0, 0));  // GGA without a fix
    EXPECT_EQ(recorder.gps_alone().report().fixes_without_gga, 1U);
    EXPECT_EQ(recorder.gps_alone().report().unusable_readings, 2U);
}

TEST(GpsAlone, FixesOfAnyDilutionAreIndependent)
{
    MotionRecorder recorder({});
    for (int i = 0; i < 2; ++i)
    {
        auto fix = gps_on_map(i, 30.0 * i, 0);
        auto& gga = fix.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
        gga.thereis_HDOP = true;
        gga.HDOP = 1 + 0.1F * static_cast<float>(i);
        recorder.feed(fix);
        recorder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto motion = recorder.gps_alone().motion(FrameId{0}, FrameId{1}).value();
    EXPECT_NEAR(motion.covariance(0, 0), 4 * (1 + 1.21), 0.05);
}

TEST(GpsAlone, GpsThatNeverMovesHasAnyHeading)
{
    MotionRecorder recorder({});
    for (int i = 0; i < 3; ++i)
    {
        recorder.feed(gps_on_map(i, 0.1 * i, 0));
        recorder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto motion = recorder.gps_alone().motion(FrameId{0}, FrameId{2});
    ASSERT_TRUE(motion);
    EXPECT_GT(motion->covariance(3, 3), 9);
}

TEST(GpsAlone, PassesOverFixesAtZero)
{
    MotionRecorder recorder({});
    recorder.feed(gps_at(0, 0, 0, 0));  // with a fix, it says
    recorder.feed(gps_on_map(1, 5, 0));
    recorder.add_frame(FrameId{0}, 1);
    const auto trajectory = recorder.gps_alone();
    EXPECT_EQ(trajectory.report().unusable_readings, 1U);
    EXPECT_NEAR(trajectory.pose(FrameId{0})->map_from_robot.x(), 0, 1e-6);
}

// The quality of a fix says how good it is.
TEST(GpsAlone, TakesTheSigmaOfTheFixesQuality)
{
    const std::vector<std::pair<std::uint8_t, double>> sigmas{
        {1, 2}, {2, 0.8}, {4, 0.03}, {5, 0.3}};
    for (const auto& [quality, sigma] : sigmas)
    {
        MotionRecorder recorder({});
        for (int i = 0; i < 2; ++i)
        {
            auto fix = gps_on_map(i, 30.0 * i, 0);
            fix.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields.fix_quality = quality;
            recorder.feed(fix);
            recorder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
        }
        const auto motion = recorder.gps_alone().motion(FrameId{0}, FrameId{1}).value();
        EXPECT_NEAR(motion.covariance(0, 0), 2 * sigma * sigma, 0.02 * sigma * sigma + 1e-4)
            << int{quality};
    }
}

}  // namespace
