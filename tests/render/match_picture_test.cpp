// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/match_picture.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <stdexcept>

namespace
{
fild::MatchPicture picture_of(const cv::Size& query, const cv::Size& candidate)
{
    fild::MatchPicture picture;
    picture.query_image = cv::Mat(query, CV_8UC3, cv::Scalar(200, 0, 0));
    picture.candidate_image = cv::Mat(candidate, CV_8UC1, cv::Scalar(90));
    picture.verdict.frame = fild::FrameId{45};
    picture.verdict.timestamp = 45;
    picture.verdict.candidate = fild::Candidate{fild::FrameId{3}, 0.9};
    return picture;
}

/** How many pixels of the region differ from the colour. */
int differing(const cv::Mat& region, const cv::Vec3b& colour)
{
    int count = 0;
    for (int y = 0; y < region.rows; ++y)
        for (int x = 0; x < region.cols; ++x) count += region.at<cv::Vec3b>(y, x) != colour ? 1 : 0;
    return count;
}

TEST(MatchPicture, StandsImagesSideBySide)
{
    const auto drawn = draw_match_picture(picture_of({320, 240}, {320, 240}));
    EXPECT_GT(drawn.cols, 640);
    EXPECT_LT(drawn.rows, 320);
    EXPECT_EQ(drawn.at<cv::Vec3b>(100, 10), cv::Vec3b(200, 0, 0));
    EXPECT_EQ(drawn.at<cv::Vec3b>(100, drawn.cols - 10), cv::Vec3b(90, 90, 90));
}

TEST(MatchPicture, StacksWideImages)
{
    const auto drawn = draw_match_picture(picture_of({1242, 375}, {1242, 375}));
    EXPECT_EQ(drawn.cols, 1242);
    EXPECT_GT(drawn.rows, 750);
    EXPECT_EQ(drawn.at<cv::Vec3b>(100, 600), cv::Vec3b(200, 0, 0));
    EXPECT_EQ(drawn.at<cv::Vec3b>(500, 600), cv::Vec3b(90, 90, 90));
}

TEST(MatchPicture, DrawsALineForEachInlierAndACaption)
{
    auto picture = picture_of({320, 240}, {200, 100});
    const auto plain = draw_match_picture(picture);
    picture.inliers = {{{100, 50}, {100, 50}}};
    const auto drawn = draw_match_picture(picture);
    const cv::Rect query(0, 0, 320, 240);
    EXPECT_EQ(differing(plain(query), {200, 0, 0}), 0);
    EXPECT_GT(differing(drawn(query), {200, 0, 0}), 200);  // from x = 100 to the edge
    const cv::Rect caption(0, 240, plain.cols, plain.rows - 240);
    EXPECT_GT(differing(plain(caption), {255, 255, 255}), 500);
}

TEST(MatchPicture, BearsTinyImagesAndPixelsOutside)
{
    auto picture = picture_of({1, 1}, {1, 1});
    picture.inliers = {{{-50, -50}, {1e4F, 1e4F}}};
    EXPECT_FALSE(draw_match_picture(picture).empty());
}

TEST(MatchPicture, RefusesAMissingImageOrCandidate)
{
    auto picture = picture_of({8, 8}, {8, 8});
    picture.verdict.candidate.reset();
    EXPECT_THROW(draw_match_picture(picture), std::invalid_argument);
    picture = picture_of({8, 8}, {8, 8});
    picture.candidate_image.release();
    EXPECT_THROW(draw_match_picture(picture), std::invalid_argument);
}

}  // namespace
