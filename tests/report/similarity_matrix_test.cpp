// SPDX-License-Identifier: BSD-3-Clause
#include "fild/report/similarity_matrix.h"

#include "temporary_folder.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <stdexcept>

namespace
{
cv::Mat1b picture_of(const fild::SimilarityMatrix& matrix)
{
    const fild::testing::TemporaryFolder folder;
    matrix.write_png(folder.path("similarity.png"));
    return cv::imread(folder.path("similarity.png"), cv::IMREAD_GRAYSCALE);
}

/** One of four descriptors whose mean is nothing. */
fild::GlobalDescriptor direction(std::size_t i)
{
    const std::vector<fild::GlobalDescriptor> all = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return all[i % all.size()];
}

TEST(SimilarityMatrix, IsTheCosineBelowTheDiagonal)
{
    fild::SimilarityMatrix matrix(100);
    for (std::size_t i = 0; i < 8; ++i) matrix.add(fild::FrameId{i}, direction(i));
    const auto picture = picture_of(matrix);
    ASSERT_EQ(picture.size(), cv::Size(8, 8));
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 8; ++column)
            EXPECT_EQ(picture(row, column), row - column == 4 ? 255 : 0) << row << " " << column;
}

TEST(SimilarityMatrix, LeavesOutWhatAllFramesShare)
{
    fild::SimilarityMatrix matrix(100);
    matrix.add(fild::FrameId{0}, {0.8F, 0.6F});
    matrix.add(fild::FrameId{1}, {0.8F, -0.6F});
    EXPECT_EQ(picture_of(matrix)(1, 0), 0);  // the cosine of the descriptors is 0.28
}

TEST(SimilarityMatrix, KeepsEveryOtherFrameWhenThereAreTooMany)
{
    fild::SimilarityMatrix matrix(10);
    for (std::size_t i = 0; i < 45; ++i) matrix.add(fild::FrameId{i}, direction(i / 8));
    EXPECT_EQ(matrix.frames_per_row(), 8U);
    const auto picture = picture_of(matrix);
    ASSERT_EQ(picture.size(), cv::Size(6, 6));
    EXPECT_GT(picture(4, 0), 200);  // of frames 32 and 0
    EXPECT_EQ(picture(2, 0), 0);
}

TEST(SimilarityMatrix, TakesFramesWithoutADescriptor)
{
    fild::SimilarityMatrix matrix(10);
    matrix.add(fild::FrameId{0}, {});
    EXPECT_EQ(picture_of(matrix).size(), cv::Size(1, 1));
    matrix.add(fild::FrameId{1}, {1, 0});
    matrix.add(fild::FrameId{2}, {});
    EXPECT_EQ(cv::countNonZero(picture_of(matrix)), 0);
    EXPECT_THROW(fild::SimilarityMatrix(0), std::invalid_argument);
}

}  // namespace
