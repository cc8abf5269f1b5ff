// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/geodetic.h"

#include "fild/core/angle.h"

#include <cmath>

namespace fild
{
namespace
{
// WGS 84: half the equatorial axis, and the square of the first eccentricity.
constexpr double kEquatorialRadius = 6378137;  // m
constexpr double kEccentricity2 = 6.69437999014e-3;

double prime_vertical_radius(double latitude)
{
    const double sine = std::sin(latitude);
    return kEquatorialRadius / std::sqrt(1 - kEccentricity2 * sine * sine);
}

cv::Vec3d earth_centred(const GeodeticPosition& place)
{
    const double latitude = place.latitude_deg * kRadiansPerDegree;
    const double longitude = place.longitude_deg * kRadiansPerDegree;
    const double radius = prime_vertical_radius(latitude);
    const double from_axis = (radius + place.height_m) * std::cos(latitude);
    return {from_axis * std::cos(longitude),
            from_axis * std::sin(longitude),
            (radius * (1 - kEccentricity2) + place.height_m) * std::sin(latitude)};
}

/** Each step is some 300 times nearer to the latitude than the one before. */
GeodeticPosition geodetic_of(const cv::Vec3d& point)
{
    constexpr int kSteps = 8;
    const double from_axis = std::hypot(point[0], point[1]);
    double latitude = std::atan2(point[2], from_axis * (1 - kEccentricity2));
    for (int i = 0; i < kSteps; ++i)
        latitude = std::atan2(
            point[2] + kEccentricity2 * prime_vertical_radius(latitude) * std::sin(latitude),
            from_axis);
    // Over the ellipsoid's normal: also defined at the poles.
    const double radius = prime_vertical_radius(latitude);
    const double height = from_axis * std::cos(latitude) + point[2] * std::sin(latitude) -
                          kEquatorialRadius * kEquatorialRadius / radius;
    return {
        latitude / kRadiansPerDegree, std::atan2(point[1], point[0]) / kRadiansPerDegree, height};
}

/** Columns: east, north and up, in earth-centred axes. */
cv::Matx33d axes_at(const GeodeticPosition& place)
{
    const double latitude = place.latitude_deg * kRadiansPerDegree;
    const double longitude = place.longitude_deg * kRadiansPerDegree;
    const double sin_lat = std::sin(latitude);
    const double cos_lat = std::cos(latitude);
    const double sin_lon = std::sin(longitude);
    const double cos_lon = std::cos(longitude);
    return {-sin_lon,
            -sin_lat * cos_lon,
            cos_lat * cos_lon,
            cos_lon,
            -sin_lat * sin_lon,
            cos_lat * sin_lon,
            0,
            cos_lat,
            sin_lat};
}
}  // namespace

EastNorthUp::EastNorthUp(const GeodeticPosition& origin)
    : origin_(origin), earth_from_origin_(earth_centred(origin)), earth_from_local_(axes_at(origin))
{
}

cv::Vec3d EastNorthUp::position_of(const GeodeticPosition& place) const
{
    return earth_from_local_.t() * (earth_centred(place) - earth_from_origin_);
}

GeodeticPosition EastNorthUp::place_of(const cv::Vec3d& position) const
{
    return geodetic_of(earth_from_local_ * position + earth_from_origin_);
}

}  // namespace fild
