// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/recorded_path.h"

#include "drawn_rawlog.h"
#include "message_of.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/gnss_messages_ascii_nmea.h>

#include <cmath>
#include <limits>

namespace
{
using fild::testing::message_of;
using fild::testing::Objects;
using ::testing::HasSubstr;

mrpt::obs::CObservation::Ptr gps(double seconds, double latitude, double longitude, int quality = 1)
{
    mrpt::obs::gnss::Message_NMEA_GGA gga;
    gga.fields.latitude_degrees = latitude;
    gga.fields.longitude_degrees = longitude;
    gga.fields.fix_quality = static_cast<std::uint8_t>(quality);
    auto observation = mrpt::obs::CObservationGPS::Create();
    observation->timestamp = mrpt::Clock::fromDouble(seconds);
    observation->sensorLabel = "GPS";
    observation->setMsg(gga);
    return observation;
}

mrpt::obs::CObservation::Ptr robot_at(double seconds, double x, double yaw)
{
    auto observation = mrpt::obs::CObservationRobotPose::Create();
    observation->timestamp = mrpt::Clock::fromDouble(seconds);
    observation->sensorLabel = "MOCAP";
    observation->pose.mean = mrpt::poses::CPose3D(x, 2, 3, yaw, 0, 0);
    return observation;
}

class RecordedPath : public ::testing::Test
{
 protected:
    fild::RecordedPath read(const Objects& objects, const std::string& label = "") const
    {
        fild::testing::write_gz(folder_.path("drive.rawlog"), objects);
        return fild::read_recorded_path(folder_.path("drive.rawlog"), label);
    }

 private:
    fild::testing::TemporaryFolder folder_;
};

// On the equator the meridian's radius of curvature is a (1 - e^2), the parallel's a.
TEST_F(RecordedPath, OfGpsIsInMetresEastAndNorth)
{
    constexpr double kEquatorialRadius = 6378137;
    constexpr double kPolarCurvature = kEquatorialRadius * (1 - 6.69437999014e-3);
    constexpr double kStep = 1e-4;  // degrees
    constexpr double kStepRadians = kStep * 3.14159265358979323846 / 180;
    const auto path = read({gps(10, 0, 20), gps(11, 0, 20 + kStep), gps(12, kStep, 20)});
    EXPECT_EQ(path.source, fild::RecordedPath::Source::gps);
    EXPECT_EQ(path.sensor_label, "GPS");
    ASSERT_EQ(path.poses.size(), 3U);
    EXPECT_NEAR(path.poses[0].seconds, 10, 1e-6);
    EXPECT_NEAR(path.poses[0].x, 0, 1e-9);
    EXPECT_NEAR(path.poses[1].x, kEquatorialRadius * kStepRadians, 1e-3);
    EXPECT_NEAR(path.poses[1].y, 0, 1e-6);
    EXPECT_NEAR(path.poses[2].x, 0, 1e-6);
    EXPECT_NEAR(path.poses[2].y, kPolarCurvature * kStepRadians, 1e-3);
}

TEST_F(RecordedPath, LeavesOutMessagesWithoutAFix)
{
    EXPECT_EQ(read({gps(10, 0, 20, 0), gps(11, 50, 8)}).poses.size(), 1U);
}

TEST_F(RecordedPath, LeavesOutWhatIsNotANumberOrHasNoTime)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto unstamped = gps(9, 51, 9);
    unstamped->timestamp = INVALID_TIMESTAMP;
    const auto fixes = read({gps(10, kNan, 20), gps(11, 0, kNan), unstamped, gps(12, 50, 8)}).poses;
    ASSERT_EQ(fixes.size(), 1U);
    EXPECT_EQ(fixes[0].x, 0) << "the first good fix is the origin";
    EXPECT_EQ(read({robot_at(1, kNan, 0), robot_at(2, 5, 0)}).poses.size(), 1U);
}

TEST_F(RecordedPath, OfRobotPosesIsInTheOrderOfTime)
{
    constexpr double kHalfTurn = 3.14159265358979323846;
    const auto path = read({robot_at(12, 7, kHalfTurn), robot_at(11, 5, 0)});
    EXPECT_EQ(path.source, fild::RecordedPath::Source::robot_pose);
    ASSERT_EQ(path.poses.size(), 2U);
    EXPECT_DOUBLE_EQ(path.poses[0].x, 5);
    EXPECT_DOUBLE_EQ(path.poses[0].qw, 1);
    EXPECT_DOUBLE_EQ(path.poses[1].x, 7);
    EXPECT_DOUBLE_EQ(path.poses[1].y, 2);
    EXPECT_DOUBLE_EQ(path.poses[1].z, 3);
    EXPECT_NEAR(std::abs(path.poses[1].qz), 1, 1e-9);
}

TEST_F(RecordedPath, IsOfTheSensorThatIsNamed)
{
    const Objects both{robot_at(1, 0, 0), gps(1, 50, 8)};
    EXPECT_EQ(read(both, "GPS").source, fild::RecordedPath::Source::gps);
    EXPECT_EQ(read(both, "MOCAP").source, fild::RecordedPath::Source::robot_pose);
    EXPECT_THAT(message_of<std::runtime_error>([&] { read(both); }),
                HasSubstr("'GPS' (GPS), 'MOCAP' (robot poses)"));
    EXPECT_THAT(message_of<std::runtime_error>([&] { read(both, "LASER"); }), HasSubstr("'LASER'"));
}

TEST_F(RecordedPath, MustBeThere)
{
    const auto image = fild::testing::image_observation(fild::testing::draw_image(), 1);
    EXPECT_THAT(message_of<std::runtime_error>(
                    [&] {
                        read({image, gps(1, 50, 8, 0)});
                    }),
                HasSubstr("neither"));
}

}  // namespace
