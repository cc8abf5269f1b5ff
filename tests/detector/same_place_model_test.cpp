// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/same_place_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace
{
using fild::Evidence;

fild::TSamePlaceOptions options()
{
    fild::TSamePlaceOptions options;
    options.enabled = true;
    options.chance.bias = -2;
    options.chance.inliers = 1;
    options.look_alike.bias = 0.5;
    options.look_alike.of_share[to_index(Evidence::inlier_share)] = 2;
    options.look_alike.of_share[to_index(Evidence::close_share)] = -1;
    return options;
}

fild::EvidenceValues halves()
{
    fild::EvidenceValues values{};
    values.fill(0.5);
    return values;
}

TEST(SamePlaceModel, AddsUpItsCoefficients)
{
    const fild::SamePlaceModel model(options());
    auto evidence = halves();
    evidence[to_index(Evidence::inlier_share)] = 0.75;  // odds 3
    evidence[to_index(Evidence::close_share)] = 0.8;  // odds 4
    const auto odds = model.odds(106, evidence);
    EXPECT_NEAR(odds.against_chance, -2 + std::log(100.0), 1e-12);
    EXPECT_NEAR(odds.against_look_alike, 0.5 + 2 * std::log(3.0) - std::log(4.0), 1e-12);
}

TEST(SamePlaceModel, TellsLookAlikesByTheSharesOfManyInliersOnly)
{
    const fild::SamePlaceModel model(options());
    const auto against_look_alike = [&](std::size_t inliers)
    { return model.odds(inliers, halves()).against_look_alike; };
    EXPECT_EQ(against_look_alike(10), 0);
    EXPECT_NEAR(against_look_alike(25), 0.25, 1e-12);
    EXPECT_EQ(against_look_alike(40), 0.5);
}

TEST(SamePlaceModel, StaysWithinWhatCanBeLearnt)
{
    auto sure = options();
    sure.chance.bias = 90;
    sure.look_alike.bias = -90;
    const auto odds = fild::SamePlaceModel(sure).odds(1000, halves());
    EXPECT_EQ(odds.against_chance, 12);
    EXPECT_EQ(odds.against_look_alike, -10);
}

TEST(SamePlaceModel, TakesSharesOfNoneAndAll)
{
    auto evidence = halves();
    evidence.fill(0);
    EXPECT_TRUE(std::isfinite(fild::SamePlaceModel(options()).odds(0, evidence).log_odds()));
    evidence.fill(1);
    EXPECT_TRUE(std::isfinite(fild::SamePlaceModel(options()).odds(0, evidence).log_odds()));
}

TEST(SamePlaceModel, ConvincesFromMinProbabilityOn)
{
    auto strict = options();
    strict.min_probability = 0.9;
    const fild::SamePlaceModel model(strict);
    EXPECT_FALSE(model.convinces({2, 2}));
    EXPECT_TRUE(model.convinces({3, 3}));
}

/** Each kind of evidence speaks in one direction only. */
TEST(SamePlaceOptions, RefuseACoefficientOfTheWrongSign)
{
    auto wrong = options();
    wrong.chance.inliers = -1;
    EXPECT_THROW(wrong.check(), std::invalid_argument);
    wrong = options();
    wrong.look_alike.of_share[to_index(Evidence::overlap_share)] = 1;
    EXPECT_THROW(wrong.check(), std::invalid_argument);
    EXPECT_NO_THROW(options().check());
}

}  // namespace
