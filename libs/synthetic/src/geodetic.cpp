// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/geodetic.h"

namespace fild
{
GeodeticPosition geodetic_from_map(const mrpt::math::TPoint3D& point)
{
    return EastNorthUp(kTownOrigin).place_of({point.x, point.y, point.z});
}

}  // namespace fild
