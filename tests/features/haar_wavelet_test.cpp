// SPDX-License-Identifier: BSD-3-Clause
#include "haar_wavelet.h"

#include "synthetic_images.h"

#include <gtest/gtest.h>

namespace
{
using fild::haar_response;
using fild::IntegralImage;

TEST(HaarWavelet, MatchesHalvesByBruteForceOnWholePixels)
{
    const cv::Mat image = fild::testing::noise_image({20, 16}, 8);
    const IntegralImage integral(image);
    const auto mean = [&](int x, int y, int width, int height)
    { return cv::mean(image(cv::Rect(x, y, width, height)))[0]; };
    // Side 4 about the corner between pixels 7|8 and 5|6: columns 6..9, rows 4..7.
    const auto haar = haar_response(integral, 7.5F, 5.5F, 4);
    EXPECT_NEAR(haar.dx, mean(8, 4, 2, 4) - mean(6, 4, 2, 4), 1e-4);
    EXPECT_NEAR(haar.dy, mean(6, 6, 4, 2) - mean(6, 4, 4, 2), 1e-4);
}

TEST(HaarWavelet, MeasuresTheSlopeOfARampAnywhere)
{
    // Slope 3 along x: exact grey values, so only the cut of pixels into constant squares is left.
    const IntegralImage integral(fild::testing::ramp_image({61, 61}, 0, 3));
    for (const float x : {20.0F, 24.5F, 30.25F, 33.7F})
        for (const float side : {4.0F, 6.4F, 9.1F})
        {
            const auto haar = haar_response(integral, x, 30.3F, side);
            EXPECT_NEAR(haar.dx, 3 * side / 2, 0.15 * side) << x << " side " << side;
            EXPECT_NEAR(haar.dy, 0, 1e-3);
        }
}

TEST(HaarWavelet, IsZeroOutsideTheImageAndReachesItsEdge)
{
    const IntegralImage integral(fild::testing::noise_image({8, 8}, 9));
    EXPECT_NE(haar_response(integral, 3.5F, 3.5F, 8).dx, 0);  // the whole image
    EXPECT_EQ(haar_response(integral, 3.6F, 3.5F, 8).dx, 0);
    EXPECT_EQ(haar_response(integral, -100, 3, 2).dy, 0);
    EXPECT_EQ(haar_response(integral, 3, 1e9F, 2).dy, 0);
    const IntegralImage pixel(cv::Mat(1, 1, CV_8U, cv::Scalar(9)));
    EXPECT_EQ(haar_response(pixel, 0, 0, 1).dx, 0);
}

}  // namespace
