// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "se3.h"

namespace fild
{
/** Covariance, in the tangent, of a movement as TGraphOptions model it: variances in proportion to
 *  its length and its angle, so that those of its parts add up to it. Pitch and roll have the
 *  heading's unless the odometry is planar, then none. */
Matrix6 movement_covariance(const TGraphOptions& options, const Rigid& movement, bool is_planar);

/** Added to the covariance of any movement, so that it can be inverted: standing still is known to
 *  some millimetres, and what a planar odometry does not see is uncertain. */
Matrix6 least_covariance(const Rigid& movement, double planar_attitude);

}  // namespace fild
