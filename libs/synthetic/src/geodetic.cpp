// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/geodetic.h"

#include <cmath>

namespace fild
{
namespace
{
constexpr double kDegPerRad = 57.29577951308232;
// WGS 84: half the equatorial axis, and the square of the first eccentricity.
constexpr double kEquatorialRadius = 6378137;  // m
constexpr double kEccentricity2 = 6.69437999014e-3;
}  // namespace

GeodeticPosition geodetic_from_map(const mrpt::math::TPoint3D& point)
{
    const double latitude = kTownOrigin.latitude_deg / kDegPerRad;
    const double bulge = 1 - kEccentricity2 * std::sin(latitude) * std::sin(latitude);
    const double prime_vertical = kEquatorialRadius / std::sqrt(bulge);
    const double meridian = prime_vertical * (1 - kEccentricity2) / bulge;
    const double north_radius = meridian + kTownOrigin.height_m;
    const double east_radius = (prime_vertical + kTownOrigin.height_m) * std::cos(latitude);
    return {kTownOrigin.latitude_deg + kDegPerRad * point.y / north_radius,
            kTownOrigin.longitude_deg + kDegPerRad * point.x / east_radius,
            kTownOrigin.height_m + point.z};
}

}  // namespace fild
