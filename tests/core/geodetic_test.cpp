// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/geodetic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using fild::EastNorthUp;
using fild::GeodeticPosition;

constexpr double kEquatorialRadius = 6378137;  // m
constexpr double kEccentricity2 = 6.69437999014e-3;
constexpr double kDegree = M_PI / 180;

// On the equator the parallel's radius of curvature is a, the meridian's a (1 - e^2).
TEST(EastNorthUp, HasMetresEastNorthAndUp)
{
    constexpr double kStep = 1e-4;  // degrees
    const EastNorthUp plane({0, 20, 5});
    const auto east = plane.position_of({0, 20 + kStep, 5});
    EXPECT_NEAR(east[0], (kEquatorialRadius + 5) * kStep * kDegree, 1e-6);
    EXPECT_NEAR(east[1], 0, 1e-9);
    const auto north = plane.position_of({kStep, 20, 5});
    EXPECT_NEAR(north[0], 0, 1e-9);
    EXPECT_NEAR(north[1], (kEquatorialRadius * (1 - kEccentricity2) + 5) * kStep * kDegree, 1e-6);
    EXPECT_NEAR(plane.position_of({0, 20, 8})[2], 3, 1e-8);
}

TEST(EastNorthUp, TurnsBackToPlaces)
{
    for (const double latitude : {-89.9, -33.0, 0.0, 36.7, 89.9})
        for (const double longitude : {-179.9999, -4.5, 0.0, 120.0})
        {
            const EastNorthUp plane({latitude, longitude, 55});
            for (const auto& position :
                 {cv::Vec3d(0, 0, 0), cv::Vec3d(300, -400, 7), cv::Vec3d(-20000, 15000, 3000)})
            {
                const auto back = plane.position_of(plane.place_of(position));
                EXPECT_LT(cv::norm(back - position), 1e-3) << latitude << " " << longitude;
            }
        }
}

TEST(EastNorthUp, SeesTheEarthFallAway)
{
    const EastNorthUp plane({36.7, -4.5, 0});
    const auto away = plane.position_of({36.7, -4.5 + 0.1, 0});  // 9 km
    EXPECT_NEAR(away[2], -away[0] * away[0] / (2 * kEquatorialRadius), 0.1);
}

TEST(EastNorthUp, CrossesTheDateLine)
{
    const EastNorthUp plane({0, 179.9999, 0});
    EXPECT_NEAR(plane.position_of({0, -179.9999, 0})[0], 2e-4 * kDegree * kEquatorialRadius, 1e-3);
}

}  // namespace
