// SPDX-License-Identifier: BSD-3-Clause
// A robot with a depth camera to its left drives along a wall, one frame a second, and then once
// more from the start, a little further on and lower.
#pragma once

#include "drawn_drive.h"
#include "fild/rawlog/camera_conversion.h"
#include "temporary_folder.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>
#include <string>

namespace fild::testing
{
/** The network tells little, so all earlier frames are candidates. */
constexpr const char* kWallConfig =
    "[global_descriptor]\nmodel_file = " FILD_TINY_NETWORK
    "\nlayers = map\ninput_width = 4\ninput_height = 4\npooling = grid\n"
    "[index]\ndelay_seconds = 5\ncandidates = 16\n"
    "[hashing]\nratio = 0.87\nmutual_check = true\n"
    "[verification]\nmethod = magsac\n"
    "[consistency]\nconsecutive_frames = 1\n";

constexpr std::size_t kWallFramesPerLap = 8;
constexpr double kWallFocal = 300;
constexpr double kWallDepth = 6;
constexpr double kWallStep = 80 / kWallFocal * kWallDepth;
constexpr double kWallShift = 7 / kWallFocal * kWallDepth;  ///< forward, of the second lap
constexpr double kWallDrop = 4 / kWallFocal * kWallDepth;  ///< downward

inline mrpt::obs::CObservation3DRangeScan::Ptr wall_scan(std::size_t frame)
{
    constexpr int kPixels = 80;
    static const cv::Mat wall = draw_wall(kPixels * kWallFramesPerLap + 400, 260, 1);
    const bool is_second = frame >= kWallFramesPerLap;
    const cv::Rect view(kPixels * static_cast<int>(frame % kWallFramesPerLap) + (is_second ? 7 : 0),
                        is_second ? 4 : 0,
                        320,
                        240);
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->hasIntensityImage = scan->hasRangeImage = true;
    scan->intensityImage = mrpt::img::CImage(cv::Mat(wall(view).clone()), mrpt::img::DEEP_COPY);
    scan->cameraParams = scan->cameraParamsIntensity =
        mrpt_camera_from({kWallFocal, kWallFocal, 159.5, 119.5, 320, 240, LensModel::none, {}});
    scan->sensorPose = mrpt::poses::CPose3D(0, 0, 1, CV_PI / 2, 0, 0);
    scan->rangeUnits = 0.001F;
    scan->rangeImage_setSize(view.height, view.width);
    scan->rangeImage.fill(static_cast<std::uint16_t>(1000 * kWallDepth));
    scan->timestamp = mrpt::Clock::fromDouble(static_cast<double>(frame));
    scan->sensorLabel = "CAMERA1";
    return scan;
}

/** Where the robot is; between the laps it is carried back. */
inline double wall_position(double seconds)
{
    constexpr double kLap = kWallFramesPerLap;
    if (seconds <= kLap - 1) return kWallStep * seconds;
    if (seconds >= kLap) return kWallStep * (seconds - kLap) + kWallShift;
    return kWallStep * (kLap - 1) * (kLap - seconds);
}

inline mrpt::obs::CObservationOdometry::Ptr wall_odometry(double seconds, double position)
{
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->sensorLabel = "ODOMETRY";
    odometry->timestamp = mrpt::Clock::fromDouble(seconds);
    odometry->odometry = {position, 0, 0};
    return odometry;
}

}  // namespace fild::testing
