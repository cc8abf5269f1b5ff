// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/sensors.h"

#include "camera_mount.h"
#include "fild/core/angle.h"

#include <mrpt/poses/CPose3D.h>

#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr double kRightAngle = 1.5707963267948966;

/** True when rays further from the axis are seen further from it, up to the corners. */
bool is_one_to_one(const CameraModel& camera)
{
    const double corner = std::hypot(camera.cx, camera.cy) / camera.fx;
    double before = 0;
    for (double ray = 0.001; before < corner; ray += 0.001)
    {
        const double squared = ray * ray;
        const double seen =
            ray * (1 + camera.distortion[0] * squared + camera.distortion[1] * squared * squared);
        if (seen <= before) return false;
        before = seen;
    }
    return true;
}
}  // namespace

void TSensorOptions::describe(OptionVisitor& visitor)
{
    visitor.choice<SensorKind>("sensor",
                               sensor,
                               {{"mono", SensorKind::mono},
                                {"stereo", SensorKind::stereo},
                                {"pair", SensorKind::pair},
                                {"rgbd", SensorKind::rgbd}});
    visitor.integer("width", width, 16, 8192);
    visitor.integer("height", height, 16, 8192);
    visitor.real("field_of_view_deg", field_of_view_deg, 10, 150);
    visitor.real("baseline_m", baseline_m, 0.01, 1.5);
    visitor.real("right_delay_seconds", right_delay_seconds, 0, 0.1);
    visitor.real("toe_in_deg", toe_in_deg, -15, 15);
    visitor.real("lens_k1", lens_k1, -0.5, 0.5);
    visitor.real("lens_k2", lens_k2, -0.3, 0.3);
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

void TSensorOptions::check_between_fields() const
{
    const bool is_bent = lens_k1 != 0 || lens_k2 != 0;
    if (is_bent && sensor == SensorKind::rgbd)
        throw std::invalid_argument("lens_k1 and lens_k2 do not go with sensor=rgbd");
    if (is_bent && !is_one_to_one(camera_of(*this)))
        throw std::invalid_argument(
            "lens_k1 and lens_k2 fold the image before its corners; take smaller ones or a smaller "
            "field_of_view_deg");
}

bool has_two_cameras(const TSensorOptions& options)
{
    return options.sensor == SensorKind::stereo || options.sensor == SensorKind::pair;
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
    if (options.lens_k1 == 0 && options.lens_k2 == 0) return camera;
    camera.lens = LensModel::plumb_bob;
    camera.distortion[0] = options.lens_k1;
    camera.distortion[1] = options.lens_k2;
    return camera;
}

mrpt::poses::CPose3D robot_from_mount(const TSensorOptions& options)
{
    const double left = has_two_cameras(options) ? options.baseline_m / 2 : 0;
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
    if (!has_two_cameras(options)) return {robot_from_first.asTPose()};
    // Of a camera's axes, y points down: the left camera turns to the right about it.
    const double toe_in = options.toe_in_deg * kRadiansPerDegree;
    const CPose3D turned_right(0, 0, 0, 0, toe_in, 0);
    const CPose3D turned_left(0, 0, 0, 0, -toe_in, 0);
    const auto robot_from_right = robot_from_first + CPose3D(options.baseline_m, 0, 0, 0, 0, 0);
    return {(robot_from_first + turned_right).asTPose(),
            (robot_from_right + turned_left).asTPose()};
}

}  // namespace fild
