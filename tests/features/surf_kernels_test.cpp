// SPDX-License-Identifier: BSD-3-Clause
// All kernels that this processor has give the bits of the portable code.
#include "surf_kernels.h"

#include "surf_pipeline.h"
#include "synthetic_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace
{
using fild::BoxMask;
using fild::HessianLayer;
using fild::IntegralImage;
using fild::Keypoint;
using fild::LocalFeatures;
using fild::SurfKernels;
using fild::TLocalFeatureOptions;
using fild::testing::noise_image;

/** Of several widths: vectors end in the middle of a row. */
std::vector<cv::Mat> images()
{
    std::vector<cv::Mat> images;
    for (const cv::Size size :
         {cv::Size(1, 1), cv::Size(7, 9), cv::Size(17, 300), cv::Size(40, 41), cv::Size(211, 173)})
        images.push_back(noise_image(size, 4));
    const cv::Size size(333, 250);
    images.push_back(draw_blobs(size, fild::testing::random_blobs(600, size, 12)));
    images.push_back(fild::testing::edge_image({200, 160}, 0.4));
    images.push_back(fild::testing::ramp_image({91, 91}, 1.2, 2));
    images.emplace_back(120, 160, CV_8U, cv::Scalar(99));
    return images;
}

/** Anywhere in the image and about it, of all sizes and directions. */
std::vector<Keypoint> random_keypoints(const cv::Size& size)
{
    std::mt19937_64 generator(8);
    std::vector<Keypoint> keypoints;
    for (int i = 0; i < 300; ++i)
    {
        const auto random = [&](double min, double max)
        { return static_cast<float>(fild::testing::uniform(generator, min, max)); };
        Keypoint keypoint;
        keypoint.x = i % 10 == 0 ? std::floor(random(0, size.width)) : random(-9, size.width + 9);
        keypoint.y = random(-9, size.height + 9);
        keypoint.size = random(9, i % 3 == 0 ? 200 : 30);
        keypoint.angle = i % 5 == 0 ? 0 : random(0, 6.28);
        keypoints.push_back(keypoint);
    }
    return keypoints;
}

template <class Numbers>
bool same_bytes(const Numbers& a, const Numbers& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

class WideSurfKernels : public ::testing::Test
{
 protected:
    void SetUp() override
    {
        wide.erase(wide.begin());
        if (wide.empty()) GTEST_SKIP() << "this processor runs the portable code";
        for (const auto& kernels : wide) std::cout << kernels.processor << "\n";
    }

    const SurfKernels portable = fild::portable_surf_kernels();
    std::vector<SurfKernels> wide = fild::surf_kernels();
};

HessianLayer filled(const IntegralImage& integral, int lobe, int step, const SurfKernels& kernels)
{
    HessianLayer layer(integral, BoxMask{lobe}, step);
    kernels.fill(integral, layer, 0, layer.rows);
    return layer;
}

TEST_F(WideSurfKernels, FillTheSameDeterminants)
{
    for (const auto& image : images())
        for (const int lobe : {3, 5, 9, 17})
            for (const int step : {1, 2, 4, 8})
            {
                const IntegralImage integral(image);
                const auto expected = filled(integral, lobe, step, portable);
                for (const auto& kernels : wide)
                    EXPECT_TRUE(same_bytes(filled(integral, lobe, step, kernels).determinant,
                                           expected.determinant))
                        << kernels.processor << " " << image.size() << " " << lobe << " " << step;
            }
}

TEST_F(WideSurfKernels, FindTheSamePeaksOfRows)
{
    std::size_t found = 0;
    for (const auto& image : images())
    {
        const auto layer = filled(IntegralImage(image), 3, 1, portable);
        for (int row = 1; row + 1 < layer.rows; ++row)
            for (const float threshold : {-1.0F, 0.0F, 500.0F})
            {
                std::vector<int> expected;
                const fild::ColumnRange range{1, layer.columns - 1};
                portable.append_peaks(layer, row, range, threshold, expected);
                found += expected.size();
                for (const auto& kernels : wide)
                {
                    std::vector<int> columns;
                    kernels.append_peaks(layer, row, range, threshold, columns);
                    ASSERT_EQ(columns, expected) << kernels.processor << " " << image.size();
                }
            }
    }
    EXPECT_GT(found, 1000U);
}

TEST_F(WideSurfKernels, GiveTheSameOrientations)
{
    for (const auto& image : images())
    {
        const IntegralImage integral(image);
        for (const auto& keypoint : random_keypoints(image.size()))
            for (const auto& kernels : wide)
                ASSERT_EQ(kernels.orient(integral, keypoint), portable.orient(integral, keypoint))
                    << kernels.processor << " " << image.size() << " at " << keypoint.x << ", "
                    << keypoint.y << " size " << keypoint.size;
    }
}

TEST_F(WideSurfKernels, GiveTheSameDescriptors)
{
    for (const auto& image : images())
    {
        const IntegralImage integral(image);
        for (const auto& keypoint : random_keypoints(image.size()))
            for (const auto& kernels : wide)
                ASSERT_TRUE(same_bytes(kernels.describe(integral, keypoint),
                                       portable.describe(integral, keypoint)))
                    << kernels.processor << " " << image.size() << " at " << keypoint.x << ", "
                    << keypoint.y << " size " << keypoint.size;
    }
}

TEST_F(WideSurfKernels, ExtractTheSameFeatures)
{
    TLocalFeatureOptions upright;
    upright.upright = true;
    TLocalFeatureOptions many;
    many.hessian_threshold = 0;
    many.layers_per_octave = 3;
    many.octaves = 2;
    TLocalFeatureOptions at_least;
    at_least.hessian_threshold = 5000;
    at_least.min_keypoints = 150;
    std::size_t found = 0;
    for (const auto& image : images())
        for (const auto& options : {TLocalFeatureOptions(), upright, many, at_least})
        {
            const auto expected = extract_surf(image, options, 1, portable);
            found += expected.size();
            for (const auto& kernels : wide)
            {
                const auto features = extract_surf(image, options, 2, kernels);
                EXPECT_TRUE(same_bytes(features.keypoints, expected.keypoints))
                    << kernels.processor << " " << image.size();
                EXPECT_TRUE(same_bytes(features.descriptors, expected.descriptors))
                    << kernels.processor << " " << image.size();
            }
        }
    EXPECT_GT(found, 2000U);
}

TEST(HessianLayer, OfABandHoldsTheRowsOfTheWhole)
{
    const cv::Mat image = noise_image({90, 80}, 5);
    const IntegralImage integral(image);
    const auto whole = filled(integral, 3, 2, fild::portable_surf_kernels());
    for (const auto& [first, last] : {std::pair(-1, 12), {10, 20}, {30, 41}, {39, 60}})
        for (const auto& kernels : fild::surf_kernels())
        {
            HessianLayer band(integral, BoxMask{3}, 2, first, last);
            const int end = std::min(last, whole.rows);
            kernels.fill(integral, band, band.first_row, end);
            ASSERT_EQ(band.determinant.size(),
                      static_cast<std::size_t>((end - std::max(first, 0)) * whole.columns));
            EXPECT_TRUE(std::equal(
                band.determinant.begin(), band.determinant.end(), whole.row(std::max(first, 0))));
        }
}

}  // namespace
