// SPDX-License-Identifier: BSD-3-Clause
// SURF-128 on real images with a known change of view (Oxford affine), see
// ../shared/data/README.md. Thresholds leave a margin to the figures in the comments, measured here
// with default options.
#include "descriptor_matches.h"
#include "fild/features/surf.h"
#include "surf_pipeline.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace
{
using fild::Keypoint;
using fild::LocalFeatures;
using fild::testing::match_by_ratio;

const std::string kFolder = FILD_TEST_DATA_DIR "/affine/";

struct View
{
    cv::Size size;
    LocalFeatures features;
};

View read_view(const std::string& name)
{
    const cv::Mat image = cv::imread(kFolder + name);
    return {image.size(), fild::SurfExtractor({}, 0).extract(image)};
}

/** Where a point of the first view is in the second. */
struct Homography
{
    cv::Matx33d matrix;

    cv::Point2d operator()(double x, double y) const
    {
        const cv::Vec3d mapped = matrix * cv::Vec3d(x, y, 1);
        return {mapped[0] / mapped[2], mapped[1] / mapped[2]};
    }
    /** Local magnification at (x, y): square root of the change of area. */
    double scale(double x, double y) const
    {
        const auto origin = (*this)(x, y);
        const auto along_x = (*this)(x + 1, y) - origin;
        const auto along_y = (*this)(x, y + 1) - origin;
        return std::sqrt(std::abs(along_x.cross(along_y)));
    }
};

Homography read_graf_homography()
{
    Homography homography;
    cv::FileStorage(kFolder + "graf/H1to3p.xml", cv::FileStorage::READ)["H13"] >> homography.matrix;
    return homography;
}

Homography read_churchill_homography(int view)
{
    Homography homography;
    std::ifstream file(kFolder + "churchill/H_1_" + std::to_string(view));
    for (double& value : homography.matrix.val) file >> value;
    EXPECT_TRUE(file) << "churchill/H_1_" << view;
    return homography;
}

bool is_inside(const cv::Point2d& point, const cv::Size& size)
{
    constexpr double kMargin = 15;
    return point.x >= kMargin && point.y >= kMargin && point.x < size.width - kMargin &&
           point.y < size.height - kMargin;
}

/** Found again: within 2.5 pixels and a factor 1.5 in scale. */
bool is_found_again(const Keypoint& keypoint,
                    const Homography& second_from_first,
                    const View& second)
{
    const auto place = second_from_first(keypoint.x, keypoint.y);
    const double size = keypoint.size * second_from_first.scale(keypoint.x, keypoint.y);
    for (const auto& other : second.features.keypoints)
    {
        const double ratio = size / other.size;
        if (ratio > 1.5 || ratio < 1 / 1.5) continue;
        if (std::hypot(other.x - place.x, other.y - place.y) <= 2.5) return true;
    }
    return false;
}

/** Keypoints found again, of the smaller number in the part both views see (Mikolajczyk). */
double repeatability(const View& first, const View& second, const Homography& second_from_first)
{
    const Homography first_from_second{second_from_first.matrix.inv()};
    std::size_t seen_by_both = 0;
    std::size_t found_again = 0;
    for (const auto& keypoint : first.features.keypoints)
    {
        if (!is_inside(second_from_first(keypoint.x, keypoint.y), second.size)) continue;
        ++seen_by_both;
        if (is_found_again(keypoint, second_from_first, second)) ++found_again;
    }
    std::size_t seen_back = 0;
    for (const auto& keypoint : second.features.keypoints)
        if (is_inside(first_from_second(keypoint.x, keypoint.y), first.size)) ++seen_back;
    return static_cast<double>(found_again) /
           static_cast<double>(std::max<std::size_t>(1, std::min(seen_by_both, seen_back)));
}

struct Quality
{
    double repeatability = 0;
    std::size_t matches = 0;  ///< ratio 0.7
    double correct_share = 0;  ///< of the matches, to 4 pixels
};

Quality compare(const std::string& name,
                const View& first,
                const View& second,
                const Homography& second_from_first)
{
    Quality quality;
    quality.repeatability = repeatability(first, second, second_from_first);
    const auto matches = match_by_ratio(first.features, second.features, 0.7);
    quality.matches = matches.size();
    quality.correct_share = static_cast<double>(count_correct(matches, second_from_first, 4.0)) /
                            static_cast<double>(std::max<std::size_t>(1, matches.size()));
    std::cout << name << ": " << first.features.size() << " and " << second.features.size()
              << " keypoints, repeatability " << quality.repeatability << ", " << quality.matches
              << " matches, right " << quality.correct_share << "\n";
    return quality;
}

class SurfOnAffineImages : public ::testing::Test
{
 protected:
    void SetUp() override
    {
        if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "missing " << kFolder;
    }
};

TEST_F(SurfOnAffineImages, GraffitiSeenThirtyDegreesAside)
{
    const auto quality = compare(
        "graf 1-3", read_view("graf/img1.png"), read_view("graf/img3.png"), read_graf_homography());
    EXPECT_GT(quality.repeatability, 0.52);  // 0.576
    EXPECT_GT(quality.matches, 180U);  // 255
    EXPECT_GT(quality.correct_share, 0.55);  // 0.667
}

TEST_F(SurfOnAffineImages, ChurchillFromFiveViews)
{
    struct Expected
    {
        int view;
        double repeatability;
        double correct_share;
    };
    const auto first = read_view("churchill/img1.jpg");
    // Measured: repeatability 0.550 0.406 0.359 0.786 0.278, right 0.884 0.748 0.757 0.968 0.400.
    for (const auto& expected : {Expected{2, 0.48, 0.80},
                                 Expected{3, 0.33, 0.62},
                                 Expected{4, 0.29, 0.62},
                                 Expected{5, 0.70, 0.92},
                                 Expected{6, 0.20, 0.20}})
    {
        const auto view = std::to_string(expected.view);
        const auto quality = compare("churchill 1-" + view,
                                     first,
                                     read_view("churchill/img" + view + ".jpg"),
                                     read_churchill_homography(expected.view));
        EXPECT_GT(quality.repeatability, expected.repeatability) << view;
        EXPECT_GT(quality.correct_share, expected.correct_share) << view;
    }
}

TEST_F(SurfOnAffineImages, LeuvenInOtherLight)
{
    const auto bright = read_view("leuven/leuvenA.jpg");
    const auto dark = read_view("leuven/leuvenB.jpg");
    const auto matches = match_by_ratio(bright.features, dark.features, 0.7);
    std::vector<cv::Point2f> from;
    std::vector<cv::Point2f> to;
    for (const auto& match : matches)
    {
        from.emplace_back(match.query->x, match.query->y);
        to.emplace_back(match.candidate->x, match.candidate->y);
    }
    ASSERT_GE(from.size(), 8U);
    cv::Mat agrees;
    cv::findFundamentalMat(from, to, cv::FM_RANSAC, 3, 0.999, agrees);
    const int inliers = cv::countNonZero(agrees);
    std::cout << "leuven A-B: " << matches.size() << " matches, " << inliers << " agree\n";
    EXPECT_GT(inliers, 90);  // 124 of 182
    EXPECT_GT(inliers, 0.5 * static_cast<double>(matches.size()));
}

TEST_F(SurfOnAffineImages, AreTheSameBytesWithAllKernelsOfThisProcessor)
{
    for (const auto* name : {"graf/img1.png", "churchill/img3.jpg", "leuven/leuvenB.jpg"})
    {
        const cv::Mat image = cv::imread(kFolder + name);
        const auto expected = fild::extract_surf(image, {}, 0, fild::portable_surf_kernels());
        for (const auto& kernels : fild::surf_kernels())
        {
            const auto features = fild::extract_surf(image, {}, 0, kernels);
            EXPECT_EQ(features.descriptors, expected.descriptors) << kernels.processor << name;
            ASSERT_EQ(features.size(), expected.size()) << kernels.processor << name;
            for (std::size_t i = 0; i < features.size(); ++i)
                ASSERT_EQ(features.keypoints[i].angle, expected.keypoints[i].angle) << i;
        }
    }
}

using Numbers = std::vector<double>;

/** Mean and mean square of each number of `descriptors`. */
struct Moments
{
    Numbers mean;
    Numbers mean_square;
};

Moments moments_of(const std::vector<float>& descriptors)
{
    Moments moments{Numbers(LocalFeatures::dimension), Numbers(LocalFeatures::dimension)};
    const std::size_t descriptor_count = descriptors.size() / LocalFeatures::dimension;
    const auto count = static_cast<double>(descriptor_count);
    for (std::size_t i = 0; i < descriptors.size(); ++i)
    {
        const double number = descriptors[i];
        moments.mean[i % LocalFeatures::dimension] += number / count;
        moments.mean_square[i % LocalFeatures::dimension] += number * number / count;
    }
    return moments;
}

/** Means over the sums of one kind of subregion (2 outer sides: corner, 1: edge, 0: inner): of dx,
 *  of |dx|, of dy and of |dy|. */
std::array<double, 4> means_of_kind(const Numbers& descriptor, int outer_sides)
{
    std::array<double, 4> sums{};
    int count = 0;
    for (std::size_t s = 0; s < 16; ++s)
    {
        const int sides = (s / 4 == 0 || s / 4 == 3 ? 1 : 0) + (s % 4 == 0 || s % 4 == 3 ? 1 : 0);
        if (sides != outer_sides) continue;
        for (const std::size_t half : {0U, 2U})
        {
            for (std::size_t k = 0; k < 4; ++k)
                sums[k] += descriptor[s * 8 + half + k % 2 + k / 2 * 4];
            ++count;
        }
    }
    for (auto& sum : sums) sum /= count;
    return sums;
}

class SurfStatistics : public SurfOnAffineImages
{
 protected:
    static std::vector<float> descriptors()
    {
        std::vector<std::string> names{
            "graf/img1.png", "graf/img3.png", "leuven/leuvenA.jpg", "leuven/leuvenB.jpg"};
        for (int i = 1; i <= 6; ++i) names.push_back("churchill/img" + std::to_string(i) + ".jpg");
        std::vector<float> all;
        for (const auto& name : names)
        {
            const auto features = read_view(name).features;
            all.insert(all.end(), features.descriptors.begin(), features.descriptors.end());
        }
        return all;
    }

    static void expect_near(const Numbers& measured,
                            const std::vector<float>& stated,
                            const std::string& name,
                            double tolerance)
    {
        const Numbers expected(stated.begin(), stated.end());
        for (int sides = 0; sides <= 2; ++sides)
        {
            const auto sums = means_of_kind(measured, sides);
            const auto expected_sums = means_of_kind(expected, sides);
            std::cout << name << ", " << sides << " outer sides:";
            for (std::size_t k = 0; k < sums.size(); ++k)
            {
                std::cout << " " << sums[k];
                EXPECT_NEAR(sums[k], expected_sums[k], tolerance) << k;
            }
            std::cout << "\n";
        }
        // Single numbers may differ more: dx is larger where dy points away from the x axis.
        for (std::size_t i = 0; i < stated.size(); ++i)
            EXPECT_NEAR(stated[i], measured[i], 0.03) << i;
    }
};

TEST_F(SurfStatistics, AreThoseOfRealDescriptors)
{
    const auto measured = moments_of(descriptors());
    expect_near(measured.mean, fild::surf_statistics().mean, "mean", 2e-3);
}

TEST_F(SurfStatistics, OfRootedDescriptorsAreThoseOfRealOnes)
{
    auto roots = descriptors();
    for (auto descriptor = roots.begin(); descriptor != roots.end();
         descriptor += LocalFeatures::dimension)
    {
        const auto end = descriptor + LocalFeatures::dimension;
        double sum = 0;
        std::for_each(descriptor, end, [&](float number) { sum += std::abs(number); });
        std::transform(descriptor,
                       end,
                       descriptor,
                       [&](float number)
                       { return std::copysign(std::sqrt(std::abs(number) / sum), number); });
    }
    const auto measured = moments_of(roots);
    Numbers deviation(LocalFeatures::dimension);
    for (std::size_t i = 0; i < deviation.size(); ++i)
        deviation[i] = std::sqrt(measured.mean_square[i] - measured.mean[i] * measured.mean[i]);
    const auto stated = fild::rooted_surf_statistics();
    expect_near(measured.mean, stated.mean, "rooted mean", 2e-3);
    expect_near(deviation, stated.deviation, "rooted deviation", 2e-3);
}

}  // namespace
