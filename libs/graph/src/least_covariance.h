// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/se3.h"

namespace fild
{
/** Added to the covariance of any movement, so that it can be inverted: standing still is known to
 *  some millimetres, and what a planar odometry does not see is uncertain.
 *  \param planar_attitude  standard deviation of pitch and roll, radians. */
Matrix6 least_covariance(const Rigid& movement, double planar_attitude);

}  // namespace fild
