// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/sensors.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>

#include <cmath>

namespace
{
using fild::camera_of;
using fild::robot_from_cameras;
using fild::SensorKind;
using fild::TSensorOptions;
using mrpt::poses::CPose3D;

TEST(Sensors, CameraHasTheFieldOfViewAndItsAxisInTheMiddle)
{
    TSensorOptions options;
    options.field_of_view_deg = 90;
    const auto camera = camera_of(options);
    EXPECT_EQ(camera.width, 640);
    EXPECT_EQ(camera.height, 480);
    // Half a pixel beyond the centre of the last one is the image's edge.
    EXPECT_NEAR((639.5 - camera.cx) / camera.fx, 1, 1e-9);
    EXPECT_NEAR((-0.5 - camera.cx) / camera.fx, -1, 1e-9);
    EXPECT_EQ(camera.fx, camera.fy);
    EXPECT_DOUBLE_EQ(camera.cy, 239.5);
}

TEST(Sensors, CamerasLookAheadWithTheRightOneToTheRight)
{
    TSensorOptions options;
    options.baseline_m = 0.4;
    options.camera_height_m = 1.5;
    const auto poses = robot_from_cameras(options);
    ASSERT_EQ(poses.size(), 2U);
    const auto left_ahead = CPose3D(poses[0]).composePoint({0, 0, 10});
    EXPECT_NEAR((left_ahead - mrpt::math::TPoint3D(10, 0.2, 1.5)).norm(), 0, 1e-9);
    const auto right_ahead = CPose3D(poses[1]).composePoint({0, 0, 10});
    EXPECT_NEAR((right_ahead - mrpt::math::TPoint3D(10, -0.2, 1.5)).norm(), 0, 1e-9);
    const auto below_right = CPose3D(poses[0]).composePoint({1, 1, 0});
    EXPECT_NEAR((below_right - mrpt::math::TPoint3D(0, -0.8, 0.5)).norm(), 0, 1e-9);
}

TEST(Sensors, APositivePitchLooksDown)
{
    TSensorOptions options;
    options.sensor = SensorKind::mono;
    options.camera_pitch_deg = 45;
    const auto poses = robot_from_cameras(options);
    ASSERT_EQ(poses.size(), 1U);
    const auto ahead = CPose3D(poses[0]).composePoint({0, 0, 1});
    EXPECT_NEAR(ahead.x, std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(ahead.y, 0, 1e-9);
    EXPECT_NEAR(ahead.z, options.camera_height_m - std::sqrt(0.5), 1e-9);
}

TEST(Sensors, RefuseALensThatFoldsTheImage)
{
    TSensorOptions options;
    options.lens_k1 = -0.28;
    EXPECT_THROW(options.check(), std::invalid_argument);
    options.lens_k2 = 0.07;
    EXPECT_NO_THROW(options.check());
    options.sensor = SensorKind::rgbd;
    EXPECT_THROW(options.check(), std::invalid_argument);
}

TEST(Sensors, RefuseOptionsOutOfRange)
{
    TSensorOptions options;
    options.max_range_m = 66;  // would not fit into 16 bit
    EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
