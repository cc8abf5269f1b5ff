// SPDX-License-Identifier: BSD-3-Clause
#include "orientation.h"

#include "synthetic_images.h"

#include <gtest/gtest.h>

namespace
{
using fild::dominant_orientation;
using fild::IntegralImage;

fild::Keypoint keypoint_at(float x, float y, float size)
{
    fild::Keypoint keypoint;
    keypoint.x = x;
    keypoint.y = y;
    keypoint.size = size;
    return keypoint;
}

TEST(DominantOrientation, IsTheDirectionOfARamp)
{
    for (int degrees = 0; degrees < 360; degrees += 15)
    {
        const double angle = degrees * CV_PI / 180;
        const IntegralImage integral(fild::testing::ramp_image({91, 91}, angle, 2));
        const double found = dominant_orientation(integral, keypoint_at(45.3F, 44.8F, 21));
        EXPECT_GE(found, 0);
        EXPECT_LT(found, 2 * CV_PI);
        EXPECT_NEAR(std::remainder(found - angle, 2 * CV_PI), 0, 0.02) << degrees << " degrees";
    }
}

TEST(DominantOrientation, TakesTheStrongerOfTwoDirections)
{
    // A roof: steep on the left (towards +x), gentle on the right (towards -x).
    cv::Mat_<std::uint8_t> roof(91, 91);
    for (int y = 0; y < roof.rows; ++y)
        for (int x = 0; x < roof.cols; ++x)
            roof(y, x) = static_cast<std::uint8_t>(x < 45 ? 5 * x : 225 - (x - 45));
    const double found = dominant_orientation(IntegralImage(roof), keypoint_at(45, 45, 21));
    EXPECT_NEAR(std::remainder(found, 2 * CV_PI), 0, 0.02);
}

TEST(DominantOrientation, IsZeroWhereNothingChanges)
{
    const cv::Mat grey(50, 50, CV_8U, cv::Scalar(77));
    EXPECT_EQ(dominant_orientation(IntegralImage(grey), keypoint_at(25, 25, 15)), 0.0F);
}

}  // namespace
