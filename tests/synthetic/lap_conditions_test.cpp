// SPDX-License-Identifier: BSD-3-Clause
#include "fild/synthetic/lap_conditions.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>

namespace
{
using fild::conditions_of_lap;
using fild::TConditionsOptions;
using fild::with_image_effects;

cv::Mat grey_image()
{
    return {120, 160, CV_8UC3, cv::Scalar(100, 128, 150)};
}

bool equal(const cv::Mat& a, const cv::Mat& b)
{
    return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(LapConditions, ChangeFromLapToLapWithinTheLimits)
{
    TConditionsOptions options;
    options.light_change = 1;
    const auto first = conditions_of_lap(options, 0, 7);
    for (int lap = 1; lap < 50; ++lap)
    {
        const auto later = conditions_of_lap(options, lap, 7);
        const double doublings = std::abs(std::log2(later.exposure / first.exposure));
        EXPECT_GE(doublings, 0.5);
        EXPECT_LE(doublings, 1);
        EXPECT_GT(std::abs(later.sun_azimuth - first.sun_azimuth), 0.7);
        EXPECT_GT(later.sun_elevation, 0.2);
        EXPECT_LT(later.sun_elevation, 1.4);
        EXPECT_NE(later.parked_cars, first.parked_cars);
    }
}

TEST(LapConditions, StayWhenNoChangeIsAskedFor)
{
    TConditionsOptions options;
    options.light_change = 0;
    options.parked_cars_change = false;
    const auto first = conditions_of_lap(options, 0, 7);
    const auto later = conditions_of_lap(options, 3, 7);
    EXPECT_EQ(later.sun_azimuth, first.sun_azimuth);
    EXPECT_EQ(later.sun_elevation, first.sun_elevation);
    EXPECT_EQ(later.exposure, first.exposure);
    EXPECT_EQ(later.parked_cars, first.parked_cars);
    EXPECT_NE(conditions_of_lap(options, 0, 8).parked_cars, first.parked_cars);
}

TEST(LapConditions, TheSeasonGoesOnAfterTheFirstLap)
{
    TConditionsOptions options;
    for (int lap = 0; lap < 5; ++lap) EXPECT_EQ(conditions_of_lap(options, lap, 7).season, 0);
    options.season_change = 0.8;
    EXPECT_EQ(conditions_of_lap(options, 0, 7).season, 0);
    for (int lap = 1; lap < 50; ++lap)
    {
        const auto season = conditions_of_lap(options, lap, 7).season;
        EXPECT_GE(season, 0.7 * 0.8);
        EXPECT_LE(season, 0.8);
    }
}

TEST(LapConditions, RefuseOptionsOutOfRange)
{
    TConditionsOptions options;
    options.light_change = 1.1;
    EXPECT_THROW(conditions_of_lap(options, 0, 1), std::invalid_argument);
    options = {};
    options.occluders = 1.1;
    EXPECT_THROW(conditions_of_lap(options, 0, 1), std::invalid_argument);
    options = {};
    options.season_change = -0.1;
    EXPECT_THROW(conditions_of_lap(options, 0, 1), std::invalid_argument);
}

TEST(ImageEffects, AddTheAskedNoiseWithoutBias)
{
    TConditionsOptions options;
    options.blur_px = 0;
    options.image_noise = 5;
    cv::Mat difference;
    cv::subtract(
        with_image_effects(grey_image(), options, 1, 0), grey_image(), difference, {}, CV_32F);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(difference, mean, deviation);
    for (int channel = 0; channel < 3; ++channel)
    {
        EXPECT_NEAR(mean[channel], 0, 0.2);
        EXPECT_NEAR(deviation[channel], 5, 0.15);
    }
}

TEST(ImageEffects, BlurAnEdgeAndKeepItsMean)
{
    cv::Mat image(40, 80, CV_8UC3, cv::Scalar::all(0));
    image.colRange(40, 80).setTo(cv::Scalar::all(200));
    TConditionsOptions options;
    options.blur_px = 2;
    options.image_noise = 0;
    const auto blurred = with_image_effects(image, options, 1, 0);
    const auto value = [&](int x) { return static_cast<int>(blurred.at<cv::Vec3b>(20, x)[0]); };
    // The integral of a normal distribution: 16 % one deviation before the edge, 84 % after.
    EXPECT_NEAR(value(37) + value(38), 2 * 200 * 0.159, 8);
    EXPECT_NEAR(value(41) + value(42), 2 * 200 * 0.841, 8);
    EXPECT_EQ(value(10), 0);
    EXPECT_EQ(value(70), 200);
}

TEST(ImageEffects, DependOnSeedAndIndexAlone)
{
    const TConditionsOptions options;
    const auto once = with_image_effects(grey_image(), options, 1, 5);
    EXPECT_TRUE(equal(once, with_image_effects(grey_image(), options, 1, 5)));
    EXPECT_FALSE(equal(once, with_image_effects(grey_image(), options, 1, 6)));
    EXPECT_FALSE(equal(once, with_image_effects(grey_image(), options, 2, 5)));
}

TEST(ImageEffects, LeaveTheGivenImageAlone)
{
    auto image = grey_image();
    TConditionsOptions options;
    with_image_effects(image, options, 1, 0);
    EXPECT_TRUE(equal(image, grey_image()));
    options.blur_px = options.image_noise = 0;
    EXPECT_TRUE(equal(with_image_effects(image, options, 1, 0), image));
}

TEST(ImageEffects, RefuseOtherPixels)
{
    const TConditionsOptions options;
    EXPECT_THROW(with_image_effects(cv::Mat(4, 4, CV_8UC1), options, 1, 0), std::invalid_argument);
    EXPECT_THROW(with_image_effects(cv::Mat(), options, 1, 0), std::invalid_argument);
}

}  // namespace
