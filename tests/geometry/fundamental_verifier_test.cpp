// SPDX-License-Identifier: BSD-3-Clause
#include "fild/geometry/fundamental_verifier.h"

#include "fild/core/random.h"
#include "message_of.h"

#include <cmath>
#include <random>

namespace
{
using fild::PixelPosition;
using fild::RansacMethod;
using fild::Rejection;

using Pixels = fild::MatchedPixels;

PixelPosition project(double x, double y, double z)
{
    return {static_cast<float>(500 * x / z + 320), static_cast<float>(500 * y / z + 240)};
}

/** `inliers` points of a scene 4 to 12 m away seen from two places, with half a pixel of noise,
 * then `outliers` pairs of unrelated pixels. */
Pixels two_views(std::size_t inliers, std::size_t outliers, std::uint64_t seed)
{
    std::mt19937_64 generator(seed);
    const auto uniform = [&](double low, double high)
    { return low + (high - low) * static_cast<double>(generator() >> 11U) * 0x1.0p-53; };
    const auto noise = [&] { return static_cast<float>(0.5 * fild::standard_normal(generator)); };
    const double c = std::cos(0.1);
    const double s = std::sin(0.1);
    Pixels pixels;
    for (std::size_t i = 0; i < inliers; ++i)
    {
        const double x = uniform(-3, 3);
        const double y = uniform(-2, 2);
        const double z = uniform(4, 12);
        auto query = project(x, y, z);
        auto candidate = project(c * x + s * z + 0.5, y + 0.1, -s * x + c * z - 0.3);
        query.x += noise();
        candidate.y += noise();
        pixels.query.push_back(query);
        pixels.candidate.push_back(candidate);
    }
    for (std::size_t i = 0; i < outliers; ++i)
    {
        pixels.query.push_back(
            {static_cast<float>(uniform(0, 640)), static_cast<float>(uniform(0, 480))});
        pixels.candidate.push_back(
            {static_cast<float>(uniform(0, 640)), static_cast<float>(uniform(0, 480))});
    }
    return pixels;
}

fild::TVerificationOptions options_of(RansacMethod method)
{
    fild::TVerificationOptions options;
    options.method = method;
    return options;
}

fild::Verification verify(const fild::TVerificationOptions& options, const Pixels& pixels)
{
    return fild::FundamentalVerifier(options, 1).verify(pixels);
}

class EachMethod : public ::testing::TestWithParam<RansacMethod>
{
};

TEST_P(EachMethod, FindsTheInliersOfATrueLoop)
{
    const auto result = verify(options_of(GetParam()), two_views(120, 80, 1));
    EXPECT_EQ(result.rejection, Rejection::none);
    std::size_t true_inliers = 0;
    for (const auto k : result.inliers) true_inliers += k < 120 ? 1 : 0;
    EXPECT_GE(true_inliers, 100U);
    EXPECT_LE(result.inliers.size() - true_inliers, 15U);  // some lie near their line by chance
}

TEST_P(EachMethod, GivesAMatrixThatMapsQueryPixelsToLinesThroughTheirMatches)
{
    const auto pixels = two_views(120, 0, 2);
    const auto result = verify(options_of(GetParam()), pixels);
    ASSERT_TRUE(result.candidate_from_query_f.has_value());
    int near = 0;
    for (std::size_t k = 0; k < pixels.query.size(); ++k)
    {
        const cv::Vec3d line =
            *result.candidate_from_query_f * cv::Vec3d(pixels.query[k].x, pixels.query[k].y, 1);
        const double distance =
            std::abs(line.dot(cv::Vec3d(pixels.candidate[k].x, pixels.candidate[k].y, 1))) /
            std::hypot(line[0], line[1]);
        near += distance < 3 ? 1 : 0;
    }
    EXPECT_GE(near, 110);
}

TEST_P(EachMethod, RejectsUnrelatedPixels)
{
    const auto result = verify(options_of(GetParam()), two_views(0, 60, 3));
    EXPECT_TRUE(result.rejection == Rejection::too_few_inliers ||
                result.rejection == Rejection::no_model)
        << to_word(result.rejection);
}

TEST_P(EachMethod, RepeatsWithTheSeed)
{
    const auto pixels = two_views(60, 60, 4);
    const auto a = verify(options_of(GetParam()), pixels);
    const auto b = verify(options_of(GetParam()), pixels);
    EXPECT_EQ(a.inliers, b.inliers);
}

TEST_P(EachMethod, TakesTwoCopiesOfOneImage)
{
    auto pixels = two_views(200, 0, 8);
    pixels.candidate = pixels.query;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        const fild::FundamentalVerifier verifier(options_of(GetParam()), seed);
        const auto result = verifier.verify(pixels);
        EXPECT_EQ(result.rejection, Rejection::none) << "seed " << seed;
        EXPECT_GE(result.inliers.size(), 150U) << "seed " << seed;
    }
}

TEST_P(EachMethod, SurvivesDegeneratePixels)
{
    const std::size_t count = 40;
    const Pixels all_equal{std::vector<PixelPosition>(count, {5, 5}),
                           std::vector<PixelPosition>(count, {7, 7})};
    EXPECT_NO_THROW(verify(options_of(GetParam()), all_equal));
    Pixels on_a_line;
    for (std::size_t i = 0; i < count; ++i)
    {
        on_a_line.query.push_back({static_cast<float>(i), 10});
        on_a_line.candidate.push_back({static_cast<float>(i), 10});
    }
    EXPECT_NO_THROW(verify(options_of(GetParam()), on_a_line));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Pixels not_numbers{std::vector<PixelPosition>(count, {nan, nan}),
                             std::vector<PixelPosition>(count, {nan, nan})};
    EXPECT_NE(verify(options_of(GetParam()), not_numbers).rejection, Rejection::none);
}

INSTANTIATE_TEST_SUITE_P(FundamentalVerifier,
                         EachMethod,
                         ::testing::Values(RansacMethod::ransac,
                                           RansacMethod::lo_ransac,
                                           RansacMethod::graph_cut,
                                           RansacMethod::magsac));

TEST(FundamentalVerifier, AsksForMinInliers)
{
    const auto pixels = two_views(60, 60, 7);
    fild::TVerificationOptions options;
    const auto lenient = verify(options, pixels);
    EXPECT_EQ(lenient.rejection, Rejection::none);
    options.min_inliers = static_cast<int>(lenient.inliers.size()) + 1;
    EXPECT_EQ(verify(options, pixels).rejection, Rejection::too_few_inliers);
}

TEST(FundamentalVerifier, DoesNotLookAtFewerMatchesThanInliersAskedFor)
{
    const fild::TVerificationOptions options;
    const auto result = verify(options, two_views(19, 0, 5));
    EXPECT_EQ(result.rejection, Rejection::too_few_matches);
    EXPECT_TRUE(result.inliers.empty());
    EXPECT_EQ(verify(options, Pixels()).rejection, Rejection::too_few_matches);
}

TEST(FundamentalVerifier, RefusesUnlikeNumbersOfPixels)
{
    Pixels pixels = two_views(30, 0, 6);
    pixels.candidate.pop_back();
    EXPECT_THROW(verify({}, pixels), std::invalid_argument);
}

TEST(VerificationOptions, NameTheFieldOutOfRange)
{
    fild::TVerificationOptions options;
    EXPECT_NO_THROW(options.check());
    options.min_inliers = 7;  // a fundamental matrix fits any 7 matches
    EXPECT_THAT(fild::testing::message_of<std::invalid_argument>([&] { options.check(); }),
                ::testing::HasSubstr("min_inliers=7 outside [8, 100000]"));
}

}  // namespace
