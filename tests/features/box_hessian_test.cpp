// SPDX-License-Identifier: BSD-3-Clause
#include "box_hessian.h"

#include "synthetic_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace
{
using fild::BoxMask;
using fild::HessianLayer;
using fild::IntegralImage;
using fild::testing::draw_blobs;

/** Weights of the masks as SURF Fig. 2 draws them, at a pixel `dx`, `dy` off the centre. */
struct MaskWeights
{
    int xx = 0;
    int yy = 0;
    int xy = 0;

    MaskWeights(int lobe, int dx, int dy)
        : xx(second_derivative(lobe, dx, dy)), yy(second_derivative(lobe, dy, dx))
    {
        const bool on_lobe = dx != 0 && dy != 0 && std::abs(dx) <= lobe && std::abs(dy) <= lobe;
        if (on_lobe) xy = (dx < 0) == (dy < 0) ? 1 : -1;
    }

    static int second_derivative(int lobe, int along, int across)
    {
        if (std::abs(across) >= lobe) return 0;
        return std::abs(along) <= (lobe - 1) / 2 ? -2 : 1;
    }
};

double brute_force_determinant(const cv::Mat& image, int lobe, int x, int y)
{
    const int reach = BoxMask{lobe}.reach();
    double xx = 0;
    double yy = 0;
    double xy = 0;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
        {
            const double grey = image.at<std::uint8_t>(y + dy, x + dx);
            const MaskWeights weights(lobe, dx, dy);
            xx += weights.xx * grey;
            yy += weights.yy * grey;
            xy += weights.xy * grey;
        }
    const double norm = 3.6 / (9 * lobe * lobe);
    return norm * norm * (xx * yy - 0.81 * xy * xy);
}

HessianLayer filled_layer(const cv::Mat& image, int lobe, int step)
{
    const IntegralImage integral(image);
    HessianLayer layer(integral, BoxMask{lobe}, step);
    fill_determinants(integral, layer, 0, layer.rows);
    return layer;
}

TEST(BoxHessian, MatchesTheMasksByBruteForce)
{
    const cv::Mat image = fild::testing::noise_image({41, 37}, 5);
    for (const int lobe : {3, 5, 9})
        for (const int step : {1, 2, 4})
        {
            const auto layer = filled_layer(image, lobe, step);
            const int reach = layer.mask.reach();
            for (int r = 0; r < layer.rows; ++r)
                for (int c = 0; c < layer.columns; ++c)
                {
                    const int x = c * step;
                    const int y = r * step;
                    const bool fits = x >= reach && y >= reach && x + reach < image.cols &&
                                      y + reach < image.rows;
                    const double expected = fits ? brute_force_determinant(image, lobe, x, y) : 0.0;
                    ASSERT_NEAR(layer.row(r)[c], expected, 1e-4 * std::abs(expected) + 1e-3)
                        << "lobe " << lobe << " step " << step << " at " << x << ", " << y;
                }
        }
}

TEST(BoxHessian, IsZeroWhereTheMaskIsLargerThanTheImage)
{
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(8, 40), cv::Size(40, 8)})
    {
        const auto layer = filled_layer(fild::testing::noise_image(size, 6), 3, 1);
        for (const float determinant : layer.determinant) EXPECT_EQ(determinant, 0.0F);
    }
}

TEST(BoxHessian, AnswersBlobsOfBothKindsStrongestAtTheirCentre)
{
    for (const double amplitude : {-80.0, 80.0})
    {
        const cv::Mat image = draw_blobs({61, 61}, {{30, 30, 2, amplitude}});
        const auto layer = filled_layer(image, 5, 1);
        const auto strongest = std::max_element(layer.determinant.begin(), layer.determinant.end());
        EXPECT_EQ(strongest - layer.determinant.begin(), 30 * 61 + 30);
    }
}

TEST(BoxHessian, QuadruplesWithTwiceTheContrast)
{
    const auto low = filled_layer(draw_blobs({61, 61}, {{30, 30, 3, 50}}), 5, 1);
    const auto high = filled_layer(draw_blobs({61, 61}, {{30, 30, 3, 100}}), 5, 1);
    EXPECT_NEAR(high.row(30)[30] / low.row(30)[30], 4.0, 0.1);
}

}  // namespace
