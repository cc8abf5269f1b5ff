// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/camera_model.h"
#include "fild/core/options.h"

#include <mrpt/math/TPose3D.h>

#include <vector>

namespace fild
{
/** What the robot sees with. */
enum class SensorKind
{
    mono,  ///< CObservationImage
    stereo,  ///< CObservationStereoImages
    pair,  ///< two cameras that record one by one: CObservationImage, CAMERA_LEFT and CAMERA_RIGHT
    rgbd  ///< CObservation3DRangeScan: colour, and depth along the optical axis
};

/** How the rawlog tells what the wheels measured. */
enum class OdometryKind
{
    none,
    planar,  ///< CObservationOdometry: the planar pose since the start
    robot_pose,  ///< CObservationRobotPose: the pose since the start in space
    action  ///< a rawlog of actions (CActionRobotMovement2D) and sensory frames
};

/** Section [sensors] of synthetic-rawlog: what the robot measures. */
struct TSensorOptions : Options
{
    SensorKind sensor = SensorKind::stereo;
    int width = 640;  ///< of each image, pixels
    int height = 480;
    double field_of_view_deg = 80;  ///< horizontal
    double baseline_m = 0.5;  ///< from the left camera to the right one (sensor = stereo, pair)
    double right_delay_seconds = 0.004;  ///< the right image is taken so much later (sensor = pair)
    double toe_in_deg = 0;  ///< each camera is turned to the other by this (sensor = stereo, pair)
    double lens_k1 = 0;  ///< distortion of every camera, plumb_bob; not with sensor = rgbd
    double lens_k2 = 0;
    double camera_height_m = 1.6;  ///< over the road
    double camera_pitch_deg = 0;  ///< positive: the camera looks down
    double max_range_m = 20;  ///< of depth that is measured (sensor = rgbd)
    OdometryKind odometry = OdometryKind::planar;
    double drift_percent = 1.5;  ///< of the odometry, see drifting_odometry()
    bool gps = false;  ///< a CObservationGPS (NMEA GGA) with each frame
    double gps_noise_m = 2;  ///< standard deviation to the east and to the north; up: twice that

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

/** True for a left and a right camera. */
bool has_two_cameras(const TSensorOptions& options);

/** The true intrinsics of every camera: its axis through the middle of the image. */
CameraModel camera_of(const TSensorOptions& options);

/** Where the cameras are on the robot (x forward, y left, z up): x right, y down, z along the
 *  optical axis. One camera, or the left and the right one, half the baseline from the middle. */
std::vector<mrpt::math::TPose3D> robot_from_cameras(const TSensorOptions& options);

}  // namespace fild
