// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/sensors.h"

#include "camera_mount.h"
#include "fild/core/angle.h"

#include <mrpt/poses/CPose3D.h>

#include <cmath>

namespace fild
{
namespace
{
constexpr double kRightAngle = 1.5707963267948966;
}  // namespace

void TSensorOptions::describe(OptionVisitor& visitor)
{
    visitor.choice<SensorKind>(
        "sensor",
        sensor,
        {{"mono", SensorKind::mono}, {"stereo", SensorKind::stereo}, {"rgbd", SensorKind::rgbd}});
    visitor.integer("width", width, 16, 8192);
    visitor.integer("height", height, 16, 8192);
    visitor.real("field_of_view_deg", field_of_view_deg, 10, 150);
    visitor.real("baseline_m", baseline_m, 0.01, 1.5);
    visitor.real("camera_height_m", camera_height_m, 0.2, 4);
    visitor.real("camera_pitch_deg", camera_pitch_deg, -45, 45);
    // Depth is stored as 16 bit millimetres.
    visitor.real("max_range_m", max_range_m, 1, 65);
    visitor.choice<OdometryKind>("odometry",
                                 odometry,
                                 {{"none", OdometryKind::none},
                                  {"planar", OdometryKind::planar},
                                  {"robot_pose", OdometryKind::robot_pose},
                                  {"action", OdometryKind::action}});
    visitor.real("drift_percent", drift_percent, 0, 50);
    visitor.flag("gps", gps);
    visitor.real("gps_noise_m", gps_noise_m, 0, 100);
}

CameraModel camera_of(const TSensorOptions& options)
{
    CameraModel camera;
    camera.width = options.width;
    camera.height = options.height;
    camera.fx = camera.fy =
        options.width / (2 * std::tan(options.field_of_view_deg / 2 * kRadiansPerDegree));
    camera.cx = (options.width - 1) / 2.0;  // pixel centres are at whole coordinates
    camera.cy = (options.height - 1) / 2.0;
    return camera;
}

mrpt::poses::CPose3D robot_from_mount(const TSensorOptions& options)
{
    const double left = options.sensor == SensorKind::stereo ? options.baseline_m / 2 : 0;
    return {0, left, options.camera_height_m, 0, options.camera_pitch_deg * kRadiansPerDegree, 0};
}

mrpt::poses::CPose3D mount_from_camera()
{
    return {0, 0, 0, -kRightAngle, 0, -kRightAngle};
}

std::vector<mrpt::math::TPose3D> robot_from_cameras(const TSensorOptions& options)
{
    using mrpt::poses::CPose3D;
    const auto robot_from_first = robot_from_mount(options) + mount_from_camera();
    if (options.sensor != SensorKind::stereo) return {robot_from_first.asTPose()};
    const auto robot_from_right = robot_from_first + CPose3D(options.baseline_m, 0, 0, 0, 0, 0);
    return {robot_from_first.asTPose(), robot_from_right.asTPose()};
}

}  // namespace fild
