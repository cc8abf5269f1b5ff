// SPDX-License-Identifier: BSD-3-Clause
#include "integral_image.h"

#include "synthetic_images.h"

#include <gtest/gtest.h>

namespace
{
using fild::IntegralImage;

TEST(IntegralImage, MatchesSumsByBruteForce)
{
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 7), cv::Size(9, 1), cv::Size(13, 11)})
    {
        const cv::Mat image = fild::testing::noise_image(size, 3);
        const IntegralImage integral(image);
        for (int y = 0; y <= size.height; ++y)
            for (int x = 0; x <= size.width; ++x)
            {
                const double sum = x == 0 || y == 0 ? 0 : cv::sum(image(cv::Rect(0, 0, x, y)))[0];
                ASSERT_EQ(integral.row(y)[x], sum) << "entry " << x << ", " << y;
            }
    }
}

TEST(IntegralImage, ReadsAPartOfALargerImage)
{
    const cv::Mat image = fild::testing::noise_image({20, 20}, 4);
    const cv::Rect part(3, 5, 7, 6);
    EXPECT_EQ(IntegralImage(image(part)).row(6)[7], cv::sum(image(part))[0]);
}

TEST(IntegralImage, RowsBeginInDifferentPartsOfTheCache)
{
    constexpr int kEntriesPerLine = 16;
    for (const int width : {1, 14, 15, 16, 1023, 1024, 1242})
    {
        const IntegralImage integral(cv::Mat(2, width, CV_8U, cv::Scalar(1)));
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(integral.row(1)) % 64, 0U) << width;
        EXPECT_GE(integral.stride(), width + 1);
        EXPECT_EQ(integral.row(2) - integral.row(1), integral.stride());
        EXPECT_EQ(integral.stride() % (2 * kEntriesPerLine), kEntriesPerLine) << width;
    }
}

TEST(IntegralImage, DifferencesStayRightWhenTheSumsWrapAround)
{
    const cv::Mat white(4200, 4200, CV_8U, cv::Scalar(255));
    const IntegralImage integral(white);
    const auto* upper = integral.row(4000);
    const auto* lower = integral.row(4200);
    EXPECT_EQ(lower[4200] - lower[3900] - upper[4200] + upper[3900], 200U * 300U * 255U);
}

}  // namespace
