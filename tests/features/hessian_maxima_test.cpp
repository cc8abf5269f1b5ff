// SPDX-License-Identifier: BSD-3-Clause
#include "hessian_maxima.h"

#include "box_hessian.h"
#include "synthetic_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

namespace
{
using fild::find_hessian_maxima;
using fild::IntegralImage;
using fild::Keypoint;
using fild::TLocalFeatureOptions;
using fild::testing::draw_blobs;

// A mask of lobe l blurs like a Gaussian of l/2 along the derivative (three boxes in a row) and up
// to 0.58 l across it, while its scale s is 0.4 l: blobs are found at 0.69 to 0.8 times their
// sigma.
constexpr double kScaleOfBlob = 0.75;
constexpr double kScaleTolerance = 0.07;

std::vector<Keypoint> maxima(const cv::Mat& image, const TLocalFeatureOptions& options = {})
{
    return find_hessian_maxima(IntegralImage(image), options, 1, fild::portable_surf_kernels());
}

TEST(HessianMaxima, FindABlobBetweenPixelsWithItsScale)
{
    for (const double sigma : {2.6, 3.0, 4.0, 5.0, 7.0})
        for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {0.3, -0.4}, {0.5, 0.5}, {-0.2, 0.1}})
            for (const double amplitude : {-100.0, 100.0})
            {
                const auto found =
                    maxima(draw_blobs({161, 161}, {{80 + dx, 80 + dy, sigma, amplitude}}));
                ASSERT_FALSE(found.empty()) << sigma;
                const auto& blob = found.front();
                EXPECT_NEAR(blob.x, 80 + dx, 0.3) << sigma;
                EXPECT_NEAR(blob.y, 80 + dy, 0.3) << sigma;
                EXPECT_NEAR(fild::scale_of_mask(blob.size) / sigma, kScaleOfBlob, kScaleTolerance)
                    << sigma;
                EXPECT_EQ(blob.angle, 0.0F);
            }
}

TEST(HessianMaxima, AreNotOnEdgesAlongTheAxesAndDiagonals)
{
    for (const int degrees : {0, 45, 90, 135, 180})
        EXPECT_EQ(maxima(fild::testing::edge_image({200, 160}, degrees * CV_PI / 180)).size(), 0U)
            << degrees << " degrees";
}

// Boxes are no Gaussians: with the paper's weight of 0.9 an edge between those directions answers.
TEST(HessianMaxima, OnObliqueEdgesAreMuchWeakerThanABlobOfTheSameContrast)
{
    const auto blob = maxima(draw_blobs({160, 160}, {{80, 80, 5, 100}})).front().response;
    for (const int degrees : {10, 17, 30, 60, 75})
    {
        auto image = fild::testing::edge_image({200, 160}, degrees * CV_PI / 180);
        image.convertTo(image, CV_8U, 100.0 / 160);
        for (const auto& keypoint : maxima(image))
            EXPECT_LT(keypoint.response, 0.2F * blob) << degrees << " degrees";
    }
}

TEST(HessianMaxima, AreNoneInImagesTooSmallOrOfOneColour)
{
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 500), cv::Size(500, 1), cv::Size(9, 9)})
        EXPECT_TRUE(maxima(fild::testing::noise_image(size, 1)).empty()) << size;
    TLocalFeatureOptions lowest;
    lowest.hessian_threshold = 0;
    for (const int grey : {0, 99, 255})
        EXPECT_TRUE(maxima(cv::Mat(120, 160, CV_8U, cv::Scalar(grey)), lowest).empty());
}

TEST(HessianMaxima, ComeStrongestFirstAndAboveTheThreshold)
{
    TLocalFeatureOptions options;
    options.hessian_threshold = 300;
    const auto found =
        maxima(draw_blobs({200, 200}, fild::testing::random_blobs(300, {200, 200}, 2)), options);
    ASSERT_GT(found.size(), 10U);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        EXPECT_GT(found[i].response, 300);
        EXPECT_LE(found[i].response, found[i == 0 ? 0 : i - 1].response);
    }
}

TEST(HessianMaxima, MaxKeypointsKeepsTheStrongestWithTiesInAFixedOrder)
{
    // Equal blobs: every determinant ties.
    std::vector<fild::testing::Blob> blobs;
    for (int y = 1; y < 5; ++y)
        for (int x = 1; x < 5; ++x) blobs.push_back({40.0 * x, 40.0 * y, 2.5, 90});
    const cv::Mat image = draw_blobs({200, 200}, blobs);
    const auto all = maxima(image);
    ASSERT_GE(all.size(), 16U);
    TLocalFeatureOptions options;
    options.max_keypoints = 6;
    const auto kept = maxima(image, options);
    ASSERT_EQ(kept.size(), 6U);
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
        EXPECT_EQ(kept[i].x, all[i].x);
        EXPECT_EQ(kept[i].y, all[i].y);
    }
}

TEST(HessianMaxima, MinKeypointsLowersTheThresholdToATenthAndNoFurther)
{
    const cv::Mat image = draw_blobs({200, 200}, fild::testing::random_blobs(300, {200, 200}, 2));
    TLocalFeatureOptions options;
    options.hessian_threshold = 20000;
    const auto strong = maxima(image, options).size();
    options.hessian_threshold = 2000;
    const auto all = maxima(image, options);
    ASSERT_GT(all.size(), strong + 2);
    options.hessian_threshold = 20000;
    options.min_keypoints = static_cast<int>(strong);
    EXPECT_EQ(maxima(image, options).size(), strong);
    options.min_keypoints = static_cast<int>(strong) + 2;
    const auto filled = maxima(image, options);
    ASSERT_EQ(filled.size(), strong + 2);
    EXPECT_EQ(filled.back().response, all[strong + 1].response);
    options.min_keypoints = 100000;
    EXPECT_EQ(maxima(image, options).size(), all.size());
}

TEST(HessianMaxima, AreFoundOnceHoweverManyLayersOctavesShare)
{
    const cv::Mat image = draw_blobs({200, 200}, {{100, 100, 5, 100}});
    for (int layers = 1; layers <= 5; ++layers)
    {
        TLocalFeatureOptions options;
        options.layers_per_octave = layers;
        const auto found = maxima(image, options);
        std::set<std::tuple<long, long, long>> places;
        for (const auto& k : found)
            places.emplace(std::lround(k.x), std::lround(k.y), std::lround(k.size));
        EXPECT_GE(found.size(), 1U) << layers << " layers";
        EXPECT_EQ(places.size(), found.size()) << layers << " layers";
    }
}

TEST(HessianMaxima, MoreOctavesFindLargerBlobs)
{
    const cv::Mat image = draw_blobs({500, 500}, {{250, 250, 14, 100}});
    TLocalFeatureOptions options;
    options.octaves = 2;
    EXPECT_TRUE(maxima(image, options).empty());
    options.octaves = 4;
    const auto found = maxima(image, options);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(fild::scale_of_mask(found.front().size) / 14, kScaleOfBlob, kScaleTolerance);
}

}  // namespace
