// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/geodetic.h"

#include "fild/core/angle.h"

#include <cmath>

namespace fild
{
namespace
{
// WGS 84: half the equatorial axis, and the square of the first eccentricity.
constexpr double kEquatorialRadius = 6378137;  // m
constexpr double kEccentricity2 = 6.69437999014e-3;
}  // namespace

GeodeticPosition geodetic_from_map(const mrpt::math::TPoint3D& point)
{
    const double latitude = kTownOrigin.latitude_deg * kRadiansPerDegree;
    const double bulge = 1 - kEccentricity2 * std::sin(latitude) * std::sin(latitude);
    const double prime_vertical = kEquatorialRadius / std::sqrt(bulge);
    const double meridian = prime_vertical * (1 - kEccentricity2) / bulge;
    const double north_radius = meridian + kTownOrigin.height_m;
    const double east_radius = (prime_vertical + kTownOrigin.height_m) * std::cos(latitude);
    return {kTownOrigin.latitude_deg + point.y / north_radius / kRadiansPerDegree,
            kTownOrigin.longitude_deg + point.x / east_radius / kRadiansPerDegree,
            kTownOrigin.height_m + point.z};
}

}  // namespace fild
