// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/trajectory.h"

#include <vector>

namespace fild
{
/** Standard deviations of a source are scaled by 1 to this much. */
constexpr double kLargestNoiseScale = 10;

/** Factors of the standard deviations of two sources. */
struct NoiseScales
{
    double odometry = 1;
    double vision = 1;
};

/** How much larger the errors of odometry and images are than their covariances say: variance
 *  components by the median over stretches of 10 m, 30 m, 100 m and 300 m, of which the largest
 *  counts, for errors that change slowly show in long ones only. What the two say differently is
 *  put down to the source that is the less certain; to both where they are alike. Lengths with
 *  fewer than five stretches are not looked at. */
NoiseScales noise_scales(const Trajectory& odometry, const Trajectory& vision);

/** The factor of standard deviations that makes squared errors as large as those of chi2 are, by
 *  one of their quantiles: the smaller it is, the more of them may be gross.
 *  \param quantile  in (0, 1). \return in [1, kLargestNoiseScale]; 1 for fewer than five. */
double noise_scale_of(std::vector<double> squared_errors,
                      int degrees_of_freedom,
                      double quantile = 0.5);

}  // namespace fild
