// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/geodetic.h"

#include <gtest/gtest.h>
#include <opencv2/core/types.hpp>

#include <cmath>

namespace
{
using fild::geodetic_from_map;
using fild::GeodeticPosition;
using fild::kTownOrigin;

/** Earth-centred coordinates of a place, by the definition of WGS 84. */
cv::Point3d geocentric(const GeodeticPosition& place)
{
    const double latitude = place.latitude_deg * M_PI / 180;
    const double longitude = place.longitude_deg * M_PI / 180;
    const double a = 6378137;
    const double f = 1 / 298.257223563;
    const double e2 = f * (2 - f);
    const double n = a / std::sqrt(1 - e2 * std::sin(latitude) * std::sin(latitude));
    return {(n + place.height_m) * std::cos(latitude) * std::cos(longitude),
            (n + place.height_m) * std::cos(latitude) * std::sin(longitude),
            (n * (1 - e2) + place.height_m) * std::sin(latitude)};
}

/** East, north and up of kTownOrigin. */
cv::Point3d east_north_up(const GeodeticPosition& place)
{
    const double latitude = kTownOrigin.latitude_deg * M_PI / 180;
    const double longitude = kTownOrigin.longitude_deg * M_PI / 180;
    const auto d = geocentric(place) - geocentric(kTownOrigin);
    const cv::Point3d east(-std::sin(longitude), std::cos(longitude), 0);
    const cv::Point3d up(std::cos(latitude) * std::cos(longitude),
                         std::cos(latitude) * std::sin(longitude),
                         std::sin(latitude));
    return {d.dot(east), d.dot(up.cross(east)), d.dot(up)};
}

TEST(Geodetic, PutsTheMapsOriginAtTheTownsOrigin)
{
    const auto place = geodetic_from_map({0, 0, 0});
    EXPECT_EQ(place.latitude_deg, kTownOrigin.latitude_deg);
    EXPECT_EQ(place.longitude_deg, kTownOrigin.longitude_deg);
    EXPECT_EQ(place.height_m, kTownOrigin.height_m);
}

TEST(Geodetic, HasXToTheEastYToTheNorthAndZUp)
{
    for (const double x : {-500.0, -20.0, 0.0, 300.0})
        for (const double y : {-400.0, 0.0, 10.0, 300.0})
        {
            const auto local = east_north_up(geodetic_from_map({x, y, 7}));
            EXPECT_NEAR(local.x, x, 0.03);
            EXPECT_NEAR(local.y, y, 0.03);
            EXPECT_NEAR(local.z, 7, 0.04);  // the Earth falls away
        }
}

}  // namespace
