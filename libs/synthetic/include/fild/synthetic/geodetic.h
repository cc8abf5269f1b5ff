// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/geodetic.h"

#include <mrpt/math/TPoint3D.h>

namespace fild
{
/** Where the synthetic town's origin (crossing (0, 0)) would be. */
constexpr GeodeticPosition kTownOrigin{36.7153, -4.4773, 55};

/** The place of a point of the town: x east, y north, z up of kTownOrigin, see EastNorthUp. */
GeodeticPosition geodetic_from_map(const mrpt::math::TPoint3D& point);

}  // namespace fild
