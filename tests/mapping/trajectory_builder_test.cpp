// SPDX-License-Identifier: BSD-3-Clause
#include "fild/mapping/trajectory_builder.h"

#include "graph/observations.h"
#include "message_of.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
using fild::FrameId;
using fild::TGraphOptions;
using fild::Trajectory;
using fild::TrajectoryBuilder;
using fild::testing::image_at;
using fild::testing::message_of;
using fild::testing::movement_2d;
using fild::testing::movement_3d;
using fild::testing::odometry_at;
using fild::testing::robot_pose_at;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/** A robot that drives at 1 m/s along x from time 0 on, with a reading each second. */
void drive(TrajectoryBuilder& builder, int from, int to)
{
    for (int i = from; i < to; ++i) builder.feed(odometry_at(i, CPose2D(i, 0, 0)));
}

double x_of(const Trajectory& trajectory, std::uint64_t frame)
{
    return trajectory.pose(FrameId{frame}).value().map_from_robot.x();
}

TEST(TrajectoryBuilder, InterpolatesBetweenReadings)
{
    TrajectoryBuilder builder({});
    builder.feed(odometry_at(10, CPose2D(5, 5, 0)));
    builder.feed(odometry_at(11, CPose2D(7, 5, 0.4)));
    builder.add_frame(FrameId{0}, 10.25);
    const auto pose = builder.build().pose(FrameId{0}).value();
    EXPECT_NEAR(pose.map_from_robot.x(), 0.5, 1e-9) << "the map begins at the first reading";
    EXPECT_NEAR(pose.map_from_robot.y(), 0, 1e-9);
    EXPECT_NEAR(pose.map_from_robot.yaw(), 0.1, 1e-9);
    EXPECT_EQ(pose.timestamp, 10.25);
}

TEST(TrajectoryBuilder, FindsReadingsThatCameAfterTheFrame)
{
    TrajectoryBuilder builder({});
    drive(builder, 0, 3);
    builder.add_frame(FrameId{0}, 3.5);
    builder.add_frame(FrameId{1}, 0.5);  // a camera that is late
    drive(builder, 3, 6);
    builder.add_frame(FrameId{2}, 5.4);  // after the last reading: the robot moves on
    builder.add_frame(FrameId{3}, 6.4);  // but nobody knows how far
    const auto trajectory = builder.build();
    EXPECT_NEAR(x_of(trajectory, 0), 3.5, 1e-9);
    EXPECT_NEAR(x_of(trajectory, 1), 0.5, 1e-9);
    EXPECT_NEAR(x_of(trajectory, 2), 5.4, 1e-9);
    EXPECT_FALSE(trajectory.pose(FrameId{3}));
    EXPECT_EQ(trajectory.report().source, "CObservationOdometry 'WHEELS'");
    EXPECT_EQ(trajectory.report().readings, 6U);
}

TEST(TrajectoryBuilder, HasNoPoseInAGap)
{
    TrajectoryBuilder builder({});
    drive(builder, 0, 3);
    drive(builder, 10, 13);
    for (std::uint64_t i = 0; i < 14; ++i)
        builder.add_frame(FrameId{i}, static_cast<double>(i) + 0.5);
    builder.add_frame(FrameId{14}, 30);
    const auto trajectory = builder.build();
    EXPECT_EQ(trajectory.report().gaps, 1U);
    EXPECT_THAT(trajectory.report().frames_without_pose,
                ElementsAre(FrameId{2},
                            FrameId{3},
                            FrameId{4},
                            FrameId{5},
                            FrameId{6},
                            FrameId{7},
                            FrameId{8},
                            FrameId{9},
                            FrameId{13},
                            FrameId{14}));
    const auto across = trajectory.motion(FrameId{1}, FrameId{10});
    ASSERT_TRUE(across) << "the odometer went on counting";
    EXPECT_NEAR(across->a_from_b.x(), 9, 1e-9);
    const auto way = across->covariance(0, 0);
    const auto without_gap = trajectory.motion(FrameId{0}, FrameId{1})->covariance(0, 0) * 9;
    EXPECT_GT(way, 1.5 * without_gap) << "what it drove in the gap may be more than its ends tell";
    EXPECT_FALSE(trajectory.pose(FrameId{2}));
    EXPECT_FALSE(trajectory.motion(FrameId{1}, FrameId{2}));
}

TEST(TrajectoryBuilder, BeginsASegmentWhereTheOdometryIsReset)
{
    TrajectoryBuilder builder({});
    drive(builder, 0, 5);
    for (int i = 5; i < 8; ++i) builder.feed(odometry_at(i, CPose2D(i - 5, 0, 0)));
    builder.feed(odometry_at(8, CPose2D(500, 0, 0)));
    for (std::uint64_t i = 0; i < 9; ++i) builder.add_frame(FrameId{i}, static_cast<double>(i));
    const auto trajectory = builder.build();
    EXPECT_EQ(trajectory.report().resets, 2U);
    EXPECT_FALSE(trajectory.motion(FrameId{4}, FrameId{5}));
    EXPECT_TRUE(trajectory.motion(FrameId{5}, FrameId{7}));
    EXPECT_NEAR(x_of(trajectory, 5), 4, 1e-9) << "the new segment begins at the last pose";
    EXPECT_NEAR(x_of(trajectory, 7), 6, 1e-9);
    EXPECT_EQ(trajectory.pose(FrameId{8})->segment, 2);
}

TEST(TrajectoryBuilder, GoesOnWhenTheClockJumpsBack)
{
    TrajectoryBuilder builder({});
    std::uint64_t frame = 0;
    for (int i = 0; i < 10; ++i)
    {
        const double seconds = i < 5 ? 100 + i : 100 + i - 5;  // 100..104 comes twice
        builder.feed(odometry_at(seconds, CPose2D(i, 0, 0)));
        builder.add_frame(FrameId{frame++}, seconds);
    }
    const auto trajectory = builder.build();
    EXPECT_EQ(trajectory.report().clock_jumps, 1U);
    for (std::uint64_t i = 0; i < 10; ++i)
        EXPECT_NEAR(x_of(trajectory, i), static_cast<double>(i), 1e-9) << i;
    EXPECT_TRUE(trajectory.motion(FrameId{2}, FrameId{8}));
}

// Of a drive of 50,000 readings some ten thousand are in memory, and no frame loses its pose.
TEST(TrajectoryBuilder, KeepsTheReadingsThatFramesNeed)
{
    TrajectoryBuilder builder({});
    std::size_t most = 0;
    std::uint64_t frame = 0;
    for (int i = 0; i < 50000; ++i)
    {
        builder.feed(odometry_at(i, CPose2D(i, 0, 0)));
        most = std::max(most, builder.readings_kept());
        if (i % 100 == 0) builder.add_frame(FrameId{frame++}, i + 0.5);
    }
    EXPECT_LT(most, 20200U);
    EXPECT_EQ(builder.readings(), 50000U);
    EXPECT_NEAR(builder.motion_so_far()->a_from_b.x(), 49999, 1e-6);
    builder.add_frame(FrameId{frame}, 45000.5);  // late, but not too late
    builder.add_frame(FrameId{frame + 1}, 5000.5);
    const auto trajectory = builder.build();
    EXPECT_THAT(trajectory.report().frames_without_pose, ElementsAre(FrameId{frame + 1}));
    for (std::uint64_t i = 0; i < frame; ++i)
        ASSERT_NEAR(x_of(trajectory, i), 100 * static_cast<double>(i) + 0.5, 1e-6) << i;
    EXPECT_NEAR(x_of(trajectory, frame), 45000.5, 1e-6);
    EXPECT_NEAR(trajectory.motion(FrameId{0}, FrameId{499})->a_from_b.x(), 49900, 1e-6);
}

// When readings are forgotten a frame stands just before the first that is left, and one after the
// last: neither is given the pose as if the robot had moved as it does in the readings next to it.
TEST(TrajectoryBuilder, ForgettingMovesNoFrame)
{
    TrajectoryBuilder builder({});
    const auto feed = [&](int i)
    { builder.feed(odometry_at(i, CPose2D(std::clamp(i - 10000, 0, 10000), 0, 0))); };
    for (int i = 0; i < 20000; ++i) feed(i);
    builder.add_frame(FrameId{0}, 9999.5);
    builder.add_frame(FrameId{1}, 20000.6);
    feed(20000);
    ASSERT_EQ(builder.readings_kept(), 10001U);
    feed(20001);
    const auto trajectory = builder.build();
    EXPECT_NEAR(x_of(trajectory, 0), 0, 1e-6) << "it drives on from 10000 s";
    EXPECT_NEAR(x_of(trajectory, 1), 10000, 1e-6) << "it stands from 20000 s";
}

// Files that have all readings before all frames, or the other way round.
TEST(TrajectoryBuilder, FindsReadingsFarFromTheFrame)
{
    constexpr std::uint64_t kLast = 30000;
    TrajectoryBuilder readings_first({});
    drive(readings_first, 0, kLast + 1);
    TrajectoryBuilder frames_first({});
    for (std::uint64_t i = 0; i < kLast; i += 1000)
        for (auto* builder : {&readings_first, &frames_first})
            builder->add_frame(FrameId{i}, static_cast<double>(i) + 0.5);
    drive(frames_first, 0, kLast + 1);
    for (const auto* builder : {&readings_first, &frames_first})
    {
        const auto trajectory = builder->build();
        EXPECT_THAT(trajectory.report().frames_without_pose, IsEmpty());
        EXPECT_NEAR(x_of(trajectory, 0), 0.5, 1e-6);
        EXPECT_NEAR(x_of(trajectory, kLast - 1000), kLast - 1000 + 0.5, 1e-6);
    }
}

// The clock jumps back again and again: of the readings of one time, that of the frame's own lap.
TEST(TrajectoryBuilder, RemembersPosesFromBeforeAClockJump)
{
    constexpr int kLap = 12000;
    constexpr int kReadings = 4 * kLap;
    TrajectoryBuilder builder({});
    for (int i = 0; i < kReadings; ++i)
    {
        const double seconds = 100 + i % kLap;
        builder.feed(odometry_at(seconds, CPose2D(i, 0, 0)));
        if (i % 5 == 0) builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, seconds);
    }
    EXPECT_LT(builder.readings_kept(), 20200U);
    const auto trajectory = builder.build();
    for (std::uint64_t i = 0; i < kReadings; i += 5)
        ASSERT_NEAR(x_of(trajectory, i), static_cast<double>(i), 1e-6) << i;
}

// One reading with a stamp far ahead, as clocks that are set do: the frames' clock stays.
TEST(TrajectoryBuilder, SurvivesAReadingFromTheFuture)
{
    TrajectoryBuilder builder({});
    for (int i = 0; i < 10; ++i)
    {
        builder.feed(odometry_at(i == 5 ? 5000 : i, CPose2D(i, 0, 0)));
        builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto trajectory = builder.build();
    EXPECT_NEAR(x_of(trajectory, 9), 9, 1e-9);
    EXPECT_NEAR(x_of(trajectory, 4), 4, 1e-9);
}

TEST(TrajectoryBuilder, LeavesOutLateAndUnusableReadings)
{
    TrajectoryBuilder builder({});
    builder.feed(odometry_at(0, CPose2D(0, 0, 0)));
    builder.feed(odometry_at(1, CPose2D(1, 0, 0)));
    builder.feed(odometry_at(1, CPose2D(7, 0, 0)));
    builder.feed(odometry_at(0.5, CPose2D(0.5, 0, 0)));
    builder.feed(odometry_at(2, CPose2D(std::numeric_limits<double>::quiet_NaN(), 0, 0)));
    auto without_time = odometry_at(0, CPose2D(9, 0, 0));
    without_time.timestamp = INVALID_TIMESTAMP;
    builder.feed(without_time);
    builder.feed(odometry_at(2, CPose2D(2, 0, 0)));
    builder.add_frame(FrameId{0}, 1.5);
    const auto trajectory = builder.build();
    EXPECT_NEAR(x_of(trajectory, 0), 1.5, 1e-9);
    EXPECT_EQ(trajectory.report().late_readings, 2U);
    EXPECT_EQ(trajectory.report().unusable_readings, 2U);
    EXPECT_EQ(trajectory.report().readings, 3U);
}

TEST(TrajectoryBuilder, UsesOneSourceAndNamesTheOthers)
{
    TrajectoryBuilder builder({});
    drive(builder, 0, 2);
    builder.feed(odometry_at(1.5, CPose2D(50, 0, 0), "OTHER"));
    builder.feed(robot_pose_at(1.6, CPose3D(70, 0, 0, 0, 0, 0), 1));
    drive(builder, 2, 3);
    builder.add_frame(FrameId{0}, 2);
    const auto trajectory = builder.build();
    EXPECT_NEAR(x_of(trajectory, 0), 2, 1e-9);
    EXPECT_THAT(trajectory.report().other_sources,
                ElementsAre("CObservationOdometry 'OTHER'", "CObservationRobotPose"));
    TGraphOptions options;
    options.motion_sensor_label = "OTHER";
    TrajectoryBuilder other(options);
    drive(other, 0, 2);
    other.feed(odometry_at(1.5, CPose2D(50, 0, 0), "OTHER"));
    EXPECT_EQ(other.build().report().source, "CObservationOdometry 'OTHER'");
}

TEST(TrajectoryBuilder, WithoutReadingsNoFrameHasAPose)
{
    TrajectoryBuilder builder({});
    builder.add_frame(FrameId{0}, 1);
    const auto trajectory = builder.build();
    EXPECT_EQ(trajectory.report().source, "");
    EXPECT_THAT(trajectory.poses(), IsEmpty());
    EXPECT_THAT(trajectory.report().frames_without_pose, ElementsAre(FrameId{0}));
}

TEST(TrajectoryBuilder, RefusesFramesThatDoNotIncrease)
{
    TrajectoryBuilder builder({});
    builder.add_frame(FrameId{3}, 1);
    EXPECT_THAT(message_of<std::invalid_argument>([&] { builder.add_frame(FrameId{3}, 2); }),
                HasSubstr("frame 3 comes after frame 3"));
}

// The first sensory frame comes before any action.
TEST(TrajectoryBuilder, ActionsLeadToTheObservationsAfterThem)
{
    TrajectoryBuilder builder({});
    for (int i = 0; i < 4; ++i)
    {
        if (i > 0) builder.feed(movement_2d(CPose2D(1, 0, 0)));
        builder.feed(image_at(i));
        builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto trajectory = builder.build();
    EXPECT_EQ(trajectory.report().source, "actions");
    for (std::uint64_t i = 0; i < 4; ++i)
        EXPECT_NEAR(x_of(trajectory, i), static_cast<double>(i), 1e-9);
}

TGraphOptions with_own_covariance()
{
    TGraphOptions options;
    options.odometry_covariance = fild::OdometryCovariance::own;
    return options;
}

TEST(TrajectoryBuilder, ActionsKeepTheirOwnCovariance)
{
    TrajectoryBuilder builder(with_own_covariance());
    builder.feed(image_at(0));
    builder.add_frame(FrameId{0}, 0);
    for (int i = 1; i < 3; ++i)
    {
        builder.feed(movement_2d(CPose2D(1, 0, 0)));
        builder.feed(image_at(i));
        builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto trajectory = builder.build();
    const auto step = trajectory.motion(FrameId{0}, FrameId{1})->covariance;
    EXPECT_NEAR(step(0, 0), 0.01, 1e-4);
    EXPECT_NEAR(step(1, 1), 0.04, 1e-4);
    EXPECT_NEAR(step(3, 3), 1e-4, 1e-6);
    const auto two = trajectory.motion(FrameId{0}, FrameId{2})->covariance;
    EXPECT_NEAR(two(0, 0), 0.02, 1e-4);
    EXPECT_NEAR(two(1, 1), 0.08 + 1e-4, 1e-4) << "the first heading's error, 1 m on";
    EXPECT_NEAR(two(3, 3), 2e-4, 1e-6);
    const auto back = trajectory.motion(FrameId{2}, FrameId{0})->covariance;
    EXPECT_NEAR(back(0, 0), 0.02, 1e-4);
    EXPECT_NEAR(back(3, 3), 2e-4, 1e-6);
}

TEST(TrajectoryBuilder, TakesActionsIn3D)
{
    TrajectoryBuilder builder({});
    builder.feed(image_at(0));
    builder.feed(movement_3d(CPose3D(0, 0, 1, 0, 0.5, 0), 0.01));
    builder.feed(movement_3d(CPose3D(1, 0, 0, 0, 0, 0), 0.01));
    builder.feed(image_at(1));
    builder.add_frame(FrameId{0}, 1);
    const auto pose = builder.build().pose(FrameId{0})->map_from_robot;
    EXPECT_NEAR(pose.x(), std::cos(0.5), 1e-9);
    EXPECT_NEAR(pose.z(), 1 - std::sin(0.5), 1e-9);
}

/** Motion from 0 to 1 of two robot poses with these variances. */
fild::RelativeMotion robot_pose_motion(double first,
                                       double second,
                                       const TGraphOptions& options = with_own_covariance())
{
    TrajectoryBuilder builder(options);
    builder.feed(robot_pose_at(0, CPose3D(), first));
    builder.feed(robot_pose_at(1, CPose3D(1, 2, 0, 0.5, 0.1, 0.2), second));
    builder.add_frame(FrameId{0}, 0);
    builder.add_frame(FrameId{1}, 1);
    return builder.build().motion(FrameId{0}, FrameId{1}).value();
}

TEST(TrajectoryBuilder, AbsoluteCovariancesThatGrowAreDeadReckoning)
{
    EXPECT_NEAR(robot_pose_motion(1, 1.5).covariance(0, 0), 0.5, 1e-3);
    EXPECT_NEAR(robot_pose_motion(1, 1).covariance(0, 0), 2, 1e-3) << "measured twice";
    EXPECT_LT(robot_pose_motion(1, 1, {}).covariance(0, 0), 0.1);
    EXPECT_LT(robot_pose_motion(0, 0).covariance(0, 0), 0.1) << "no covariance: the model";
}

// The map begins at the first reading, whichever way the sensor's axes lie.
TEST(TrajectoryBuilder, AbsoluteCovariancesTurnWithTheMap)
{
    TrajectoryBuilder builder(with_own_covariance());
    for (int i = 0; i < 2; ++i)
    {
        auto reading = robot_pose_at(i, CPose3D(0, i, 0, M_PI / 2, 0, 0), 1e-4);
        reading.pose.cov(0, 0) = 0.04 * (i + 1);  // across the way
        reading.pose.cov(1, 1) = 0.01 * (i + 1);  // along it
        builder.feed(reading);
        builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto motion = builder.build().motion(FrameId{0}, FrameId{1}).value();
    EXPECT_NEAR(motion.a_from_b.x(), 1, 1e-9);
    EXPECT_NEAR(motion.covariance(0, 0), 0.01, 1e-3);
    EXPECT_NEAR(motion.covariance(1, 1), 0.04, 1e-3);
}

TEST(TrajectoryBuilder, TellsTheMotionSoFar)
{
    TrajectoryBuilder builder({});
    EXPECT_FALSE(builder.motion_so_far());
    builder.feed(odometry_at(0, CPose2D(5, 5, 0)));
    EXPECT_FALSE(builder.motion_so_far());
    builder.feed(odometry_at(1, CPose2D(6, 5, 0)));
    builder.feed(odometry_at(2, CPose2D(7, 5, 0.5)));
    EXPECT_EQ(builder.readings(), 3U);
    builder.add_frame(FrameId{0}, 0);
    builder.add_frame(FrameId{1}, 2);
    const auto motion = builder.motion_so_far().value();
    const auto expected = builder.build().motion(FrameId{0}, FrameId{1}).value();
    EXPECT_EQ(motion.a_from_b, expected.a_from_b);
    EXPECT_EQ(motion.covariance, expected.covariance);
    builder.feed(odometry_at(3, CPose2D()));
    EXPECT_FALSE(builder.motion_so_far()) << "the odometry was reset";
}

TEST(TrajectoryBuilder, ModelIsThatOfTheOptions)
{
    TGraphOptions options;
    options.drift_percent = 2;
    options.heading_drift_deg = 3;
    options.turn_drift_percent = 4;
    TrajectoryBuilder builder(options);
    builder.feed(odometry_at(0, CPose2D(0, 0, 0)));
    builder.feed(odometry_at(10, CPose2D(100, 0, 0)));
    builder.feed(odometry_at(11, CPose2D(100, 0, M_PI / 2)));
    builder.feed(odometry_at(12, CPose2D(100, 0, M_PI / 2)));
    for (std::uint64_t i : {0U, 10U, 11U, 12U})
        builder.add_frame(FrameId{i}, static_cast<double>(i));
    const auto trajectory = builder.build();
    const auto deviation = [&](std::uint64_t a, std::uint64_t b, int i)
    { return std::sqrt(trajectory.motion(FrameId{a}, FrameId{b})->covariance(i, i)); };
    EXPECT_NEAR(deviation(0, 10, 0), 2, 1e-3);
    EXPECT_NEAR(deviation(0, 10, 3), 3 * M_PI / 180, 1e-4);
    EXPECT_NEAR(deviation(0, 10, 4), 0.5 * M_PI / 180, 1e-4) << "planar_attitude_deg";
    EXPECT_NEAR(deviation(10, 11, 3), 0.04 * M_PI / 2, 1e-4);
    EXPECT_NEAR(deviation(11, 12, 0), 0.005, 1e-6) << "standing still";
}

TEST(TrajectoryBuilder, DoesNotCountAGapAsDriven)
{
    TGraphOptions options;
    options.drift_percent = 2;
    TrajectoryBuilder builder(options);
    builder.feed(odometry_at(0, CPose2D(0, 0, 0)));
    for (int i = 0; i <= 10; ++i) builder.feed(odometry_at(100 + i, CPose2D(i, 0, 0)));
    builder.feed(odometry_at(210, CPose2D(10, 0, 0)));
    builder.add_frame(FrameId{0}, 110);
    builder.add_frame(FrameId{1}, 210);
    const auto motion = builder.build().motion(FrameId{0}, FrameId{1});
    ASSERT_TRUE(motion);
    EXPECT_NEAR(std::sqrt(motion->covariance(0, 0)), 2, 0.1) << "100 s at 1 m/s, of which 2 %";
}

TEST(TrajectoryBuilder, ActionsThatLeadTooFarBeginASegment)
{
    TrajectoryBuilder builder({});
    for (int i = 0; i < 6; ++i)
    {
        if (i > 0) builder.feed(movement_2d(CPose2D(i == 3 ? 500 : 1, 0, 0)));
        builder.feed(image_at(i));
        builder.add_frame(FrameId{static_cast<std::uint64_t>(i)}, i);
    }
    const auto trajectory = builder.build();
    EXPECT_EQ(trajectory.report().resets, 1U);
    EXPECT_FALSE(trajectory.motion(FrameId{2}, FrameId{3}));
    EXPECT_NEAR(trajectory.motion(FrameId{3}, FrameId{5})->a_from_b.x(), 2, 1e-9);
    EXPECT_NEAR(trajectory.pose(FrameId{5})->map_from_robot.x(), 4, 1e-9);
}

}  // namespace
