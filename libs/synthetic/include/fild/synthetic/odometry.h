// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose3D.h>

#include <cstdint>
#include <vector>

namespace fild
{
/** What an odometry measures. */
enum class OdometryDimensions
{
    planar,  ///< x, y and heading; all else is 0
    spatial  ///< all six; roll and pitch without error, as gravity shows them
};

/** What an odometry that drifts says on a drive: true movements from pose to pose, with errors that
 *  grow with the way (scale, heading, height) and with the angle turned. Most of each error is a
 *  bias that changes slowly, within some 100 m; the rest is independent from movement to movement.
 *
 *  \param map_from_robot  true poses, in order.
 *  \param drift_percent  >= 0: the expected error of the position after 100 m, relative to the pose
 *         at their beginning, in percent of them; the mean over all stretches of 100 m of a drive,
 *         as the KITTI benchmark measures (Geiger et al., CVPR 2012), varies about it.
 *  \return start_from_robot for each pose, so the first is the identity.
 *  Deterministic by seed. \throw std::invalid_argument on a negative drift. */
std::vector<mrpt::math::TPose3D> drifting_odometry(
    const std::vector<mrpt::math::TPose3D>& map_from_robot,
    OdometryDimensions dimensions,
    double drift_percent,
    std::uint64_t seed);

/** Standard deviations of an odometry. Value type. */
struct OdometryDeviation
{
    double position_m = 0;  ///< along each axis
    double heading_rad = 0;
};

/** A rough model of how far drifting_odometry() is off after so many metres: in proportion to them,
 *  and never 0, so that a covariance made from it can be inverted. */
OdometryDeviation odometry_deviation(double drift_percent, double metres);

}  // namespace fild
