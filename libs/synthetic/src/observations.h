// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/odometry.h"
#include "fild/synthetic/sensors.h"

#include <mrpt/img/CImage.h>
#include <mrpt/math/TPose3D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <vector>

namespace fild
{
// Each of these makes one observation of a frame, with true calibration and sensor poses. `stamp`
// is the frame's time.

/** One, or one of each camera of a pair. \param images  one, or the left and the right one, as they
 *  are to stand in the rawlog.
 *  \param depth  of the first image: float, metres, 0 where there is none; for rgbd only. */
std::vector<mrpt::obs::CObservation::Ptr> camera_observations(
    const TSensorOptions& options,
    mrpt::Clock::time_point stamp,
    const std::vector<mrpt::img::CImage>& images,
    const cv::Mat& depth);

/** \param start_from_robot  of the odometry, planar. */
mrpt::obs::CObservation::Ptr planar_odometry_observation(
    mrpt::Clock::time_point stamp, const mrpt::math::TPose3D& start_from_robot);

/** \param start_from_robot  of the odometry, in space. \param deviation  makes its covariance. */
mrpt::obs::CObservation::Ptr robot_pose_observation(mrpt::Clock::time_point stamp,
                                                    const mrpt::math::TPose3D& start_from_robot,
                                                    const OdometryDeviation& deviation);

/** The movement since the frame before, by the odometry. */
mrpt::obs::CActionCollection movement_action(mrpt::Clock::time_point stamp,
                                             const mrpt::math::TPose3D& start_from_before,
                                             const mrpt::math::TPose3D& start_from_robot);

/** A GPS above the robot's origin, with the options' noise. \param frame  the noise depends on it
 *  and on the seed only. */
mrpt::obs::CObservation::Ptr gps_observation(const TSensorOptions& options,
                                             mrpt::Clock::time_point stamp,
                                             const mrpt::math::TPose3D& map_from_robot,
                                             std::uint64_t seed,
                                             std::uint64_t frame);

}  // namespace fild
