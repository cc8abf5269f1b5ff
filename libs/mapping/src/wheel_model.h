// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/graph/se3.h"

namespace fild
{
/** Covariance, in the tangent, of a movement as TGraphOptions model it: variances in proportion to
 *  its length and its angle, so that those of its parts add up to it. Pitch and roll have the
 *  heading's unless the odometry is planar, then none. */
Matrix6 movement_covariance(const TGraphOptions& options, const Rigid& movement, bool is_planar);

}  // namespace fild
