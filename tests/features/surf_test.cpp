// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/surf.h"

#include "descriptor_matches.h"
#include "message_of.h"
#include "synthetic_images.h"

#include <opencv2/imgproc.hpp>

#include <cmath>
#include <tuple>

namespace
{
using fild::LocalFeatures;
using fild::SurfExtractor;
using fild::TLocalFeatureOptions;
using fild::testing::draw_blobs;
using fild::testing::match_by_ratio;
using fild::testing::message_of;
using fild::testing::random_blobs;
using fild::testing::Similarity;
using ::testing::HasSubstr;

constexpr int kSide = 360;

cv::Mat texture(const Similarity& place = {})
{
    return draw_blobs({kSide, kSide}, random_blobs(900, {kSide, kSide}, 11), place);
}

/** Turn and zoom about the middle of the texture. */
Similarity about_middle(double angle_deg, double scale)
{
    Similarity place;
    place.angle = angle_deg * CV_PI / 180;
    place.scale = scale;
    const auto moved = place(kSide / 2.0, kSide / 2.0);
    place.shift_x = kSide / 2.0 - moved.x;
    place.shift_y = kSide / 2.0 - moved.y;
    return place;
}

LocalFeatures extract(const cv::Mat& image,
                      const TLocalFeatureOptions& options = {},
                      int threads = 1)
{
    return SurfExtractor(options, threads).extract(image);
}

/** The features whose place in the other image, and 20 pixels about it, is inside. */
LocalFeatures seen_in_both(const LocalFeatures& features, const Similarity& place)
{
    const cv::Rect inside(20, 20, kSide - 40, kSide - 40);
    LocalFeatures seen;
    for (std::size_t i = 0; i < features.size(); ++i)
    {
        if (!inside.contains(place(features.keypoints[i].x, features.keypoints[i].y))) continue;
        seen.keypoints.push_back(features.keypoints[i]);
        const auto* first = features.descriptor(i);
        seen.descriptors.insert(seen.descriptors.end(), first, first + LocalFeatures::dimension);
    }
    return seen;
}

/** Share of ratio-0.8 matches that are right to 2 pixels of the smaller picture, of the features
 *  that both pictures show; fails when there are few. */
double correct_share(const LocalFeatures& a, const LocalFeatures& b, const Similarity& place)
{
    const auto seen = seen_in_both(a, place);
    const auto matches = match_by_ratio(seen, b, 0.8);
    EXPECT_GT(matches.size(), 30U);
    if (matches.empty()) return 0;
    const double tolerance = 2 * std::max(1.0, place.scale);
    return static_cast<double>(count_correct(matches, place, tolerance)) /
           static_cast<double>(matches.size());
}

auto fields(const fild::Keypoint& k)
{
    return std::make_tuple(k.x, k.y, k.size, k.angle, k.response);
}

void expect_same(const LocalFeatures& a, const LocalFeatures& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_EQ(fields(a.keypoints[i]), fields(b.keypoints[i])) << i;
    EXPECT_EQ(a.descriptors, b.descriptors);
}

TEST(SurfExtractor, GivesFiniteKeypointsInsideTheImageAndUnitDescriptors)
{
    const auto features = extract(texture());
    ASSERT_GT(features.size(), 200U);
    ASSERT_EQ(features.descriptors.size(), features.size() * LocalFeatures::dimension);
    for (std::size_t i = 0; i < features.size(); ++i)
    {
        const auto& keypoint = features.keypoints[i];
        EXPECT_TRUE(keypoint.x > 0 && keypoint.x < kSide && keypoint.y > 0 && keypoint.y < kSide);
        EXPECT_TRUE(keypoint.angle >= 0 && keypoint.angle < 2 * CV_PI);
        EXPECT_GE(keypoint.size, 9);
        double squared = 0;
        for (std::size_t d = 0; d < LocalFeatures::dimension; ++d)
            squared += features.descriptor(i)[d] * features.descriptor(i)[d];
        EXPECT_NEAR(squared, 1.0, 1e-5);
    }
}

TEST(SurfExtractor, DescribesATurnedTextureAlike)
{
    const auto reference = extract(texture());
    for (const double degrees : {10.0, 45.0, 90.0, 137.0, 180.0, 270.0})
    {
        const auto place = about_middle(degrees, 1);
        EXPECT_GT(correct_share(reference, extract(texture(place)), place), 0.9) << degrees;
    }
}

TEST(SurfExtractor, DescribesAZoomedTextureAlike)
{
    const auto reference = extract(texture());
    for (const double scale : {0.7, 1.4, 2.0})
    {
        const auto place = about_middle(20, scale);
        EXPECT_GT(correct_share(reference, extract(texture(place)), place), 0.9) << scale;
    }
}

TEST(SurfExtractor, DescribesADarkerPalerTextureAlike)
{
    const cv::Mat image = texture();
    cv::Mat changed;
    image.convertTo(changed, CV_8U, 0.5, 20);
    EXPECT_GT(correct_share(extract(image), extract(changed), {}), 0.95);
}

TEST(SurfExtractor, UprightGivesAnglesOfZero)
{
    TLocalFeatureOptions options;
    options.upright = true;
    const auto features = extract(texture(), options);
    ASSERT_GT(features.size(), 200U);
    for (const auto& keypoint : features.keypoints) EXPECT_EQ(keypoint.angle, 0.0F);
    const auto place = about_middle(5, 1);
    EXPECT_GT(correct_share(features, extract(texture(place), options), place), 0.9);
}

TEST(SurfExtractor, MaxKeypointsGivesTheFirstOfAll)
{
    const auto all = extract(texture());
    TLocalFeatureOptions options;
    options.max_keypoints = 25;
    auto first = all;
    first.keypoints.resize(25);
    first.descriptors.resize(25 * LocalFeatures::dimension);
    expect_same(extract(texture(), options), first);
}

TEST(SurfExtractor, GivesTheSameBytesWithAnyNumberOfThreads)
{
    const cv::Mat image = fild::testing::noise_image({211, 173}, 3);
    const auto reference = extract(image);
    ASSERT_GT(reference.size(), 100U);
    for (const int threads : {0, 2, 3, 7}) expect_same(extract(image, {}, threads), reference);
}

TEST(SurfExtractor, TakesColourAsItsGrey)
{
    const cv::Mat grey = texture();
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
    expect_same(extract(colour), extract(grey));
}

TEST(SurfExtractor, FindsNothingInImagesTooSmallOrOfOneColour)
{
    for (const cv::Size size :
         {cv::Size(1, 1), cv::Size(1, 300), cv::Size(300, 1), cv::Size(3, 3), cv::Size(22, 22)})
        EXPECT_EQ(extract(fild::testing::noise_image(size, 2)).size(), 0U) << size;
    EXPECT_EQ(extract(cv::Mat::zeros(100, 100, CV_8UC3)).size(), 0U);
    EXPECT_EQ(extract(cv::Mat(100, 100, CV_8U, cv::Scalar(255))).size(), 0U);
}

TEST(SurfExtractor, StaysFiniteOnEverySmallSize)
{
    TLocalFeatureOptions lowest;
    lowest.hessian_threshold = 0;
    for (int side = 20; side < 60; ++side)
    {
        const auto features = extract(fild::testing::noise_image({side, 77 - side}, 5), lowest);
        for (const float value : features.descriptors) ASSERT_TRUE(std::isfinite(value)) << side;
    }
}

TEST(SurfExtractor, RefusesImagesItCannotRead)
{
    EXPECT_THAT(message_of<std::invalid_argument>([] { extract(cv::Mat()); }), HasSubstr("empty"));
    for (const int type : {CV_16UC1, CV_32FC1, CV_8UC2, CV_8UC4})
        EXPECT_THAT(message_of<std::invalid_argument>(
                        [&] { extract(cv::Mat(50, 50, type, cv::Scalar::all(0))); }),
                    HasSubstr(cv::typeToString(type)));
}

TEST(SurfExtractor, RefusesOptionsOutOfRange)
{
    TLocalFeatureOptions options;
    options.octaves = 0;
    EXPECT_THROW(SurfExtractor(options, 1), std::invalid_argument);
    EXPECT_THROW(SurfExtractor({}, -1), std::invalid_argument);
}

}  // namespace
