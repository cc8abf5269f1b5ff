// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/geodetic.h"

#include <gtest/gtest.h>

namespace
{
using fild::geodetic_from_map;
using fild::kTownOrigin;

TEST(Geodetic, PutsTheMapsOriginAtTheTownsOrigin)
{
    const auto place = geodetic_from_map({0, 0, 0});
    EXPECT_NEAR(place.latitude_deg, kTownOrigin.latitude_deg, 1e-12);
    EXPECT_NEAR(place.longitude_deg, kTownOrigin.longitude_deg, 1e-12);
    EXPECT_NEAR(place.height_m, kTownOrigin.height_m, 1e-6);
}

TEST(Geodetic, HasXToTheEastYToTheNorthAndZUp)
{
    for (const double x : {-500.0, -20.0, 0.0, 300.0})
        for (const double y : {-400.0, 0.0, 10.0, 300.0})
        {
            const auto local =
                fild::EastNorthUp(kTownOrigin).position_of(geodetic_from_map({x, y, 7}));
            EXPECT_NEAR(local[0], x, 1e-3);
            EXPECT_NEAR(local[1], y, 1e-3);
            EXPECT_NEAR(local[2], 7, 1e-3);
        }
}

}  // namespace
