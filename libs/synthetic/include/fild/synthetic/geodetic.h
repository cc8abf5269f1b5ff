// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint3D.h>

namespace fild
{
/** A place on the Earth. Value type. */
struct GeodeticPosition
{
    double latitude_deg = 0;  ///< WGS 84, north positive
    double longitude_deg = 0;  ///< east positive
    double height_m = 0;  ///< over the ellipsoid
};

/** Where the synthetic town's origin (crossing (0, 0)) would be. */
constexpr GeodeticPosition kTownOrigin{36.7153, -4.4773, 55};

/** The place of a point of the town: x east, y north, z up of kTownOrigin. Linear in x and y;
 * within 3 cm at 500 m from the origin. */
GeodeticPosition geodetic_from_map(const mrpt::math::TPoint3D& point);

}  // namespace fild
