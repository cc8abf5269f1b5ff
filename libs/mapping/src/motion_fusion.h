// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/trajectory.h"

#include <cstddef>
#include <vector>

namespace fild
{
/** What odometry and images say of the motion, joined. Value type. */
struct FusedMotion
{
    std::vector<MeasuredMotion> motions;  ///< between frames that follow each other
    std::size_t from_odometry = 0;  ///< motions that only the odometry knows
    std::size_t from_images = 0;
    std::size_t from_both = 0;
    std::size_t contradictions =
        0;  ///< of those from both: further apart than their covariances say
};

/** Length of the way by the odometry, divided by that by the images, over the frames of the images
 *  between which either says that the robot moved. 1 when there are none. */
double length_ratio(const Trajectory& odometry, const Trajectory& vision);

/** The motions from frame to frame, by both sources where both know them: their mean, each with the
 *  weight of its covariance. Where the two contradict each other (0.999 of chi2 with 6 degrees of
 *  freedom) each may be wrong by all of the difference: it is added to both covariances. A frame
 *  between two frames of the images' chain, such as one of another camera, is where the odometry
 *  says, and its share of the way is corrected.
 *  \param odometry_variance_scale,vision_variance_scale  factors of the covariances. */
FusedMotion fused_motion(const Trajectory& odometry,
                         double odometry_variance_scale,
                         const Trajectory& vision,
                         double vision_variance_scale);

}  // namespace fild
