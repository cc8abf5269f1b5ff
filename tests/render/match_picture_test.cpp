// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/match_picture.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <limits>
#include <stdexcept>
#include <vector>

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

const cv::Vec3b kQueryColour(200, 0, 0);
const cv::Vec3b kCandidateColour(90, 90, 90);

/** The part of a picture that one image fills: its rows and columns that have its colour. */
cv::Rect area_of(const cv::Mat& picture, const cv::Vec3b& colour)
{
    cv::Mat mask;
    cv::inRange(picture, colour, colour, mask);
    std::vector<cv::Point> points;
    cv::findNonZero(mask, points);
    return points.empty() ? cv::Rect() : cv::boundingRect(points);
}

/** A grid of matches over images of one size, moved by some pixels. */
std::vector<fild::PixelPair> grid_of_pairs(const cv::Size& size, int count_across)
{
    std::vector<fild::PixelPair> pairs;
    for (int row = 0; row < count_across; ++row)
        for (int column = 0; column < count_across; ++column)
        {
            const auto x = static_cast<float>((column + 1) * size.width) /
                           static_cast<float>(count_across + 1);
            const auto y =
                static_cast<float>((row + 1) * size.height) / static_cast<float>(count_across + 1);
            pairs.push_back({{x, y}, {x + 5, y}});
        }
    return pairs;
}

TEST(MatchPicture, StandsImagesSideBySide)
{
    const auto drawn = draw_match_picture(picture_of({640, 480}, {640, 480}), {});
    const auto query = area_of(drawn, kQueryColour);
    const auto candidate = area_of(drawn, kCandidateColour);
    EXPECT_EQ(query.size(), cv::Size(640, 480)) << "not scaled";
    EXPECT_EQ(candidate.size(), query.size());
    EXPECT_GT(candidate.x, query.br().x);
    EXPECT_EQ(candidate.y, query.y);
}

TEST(MatchPicture, StacksWideImages)
{
    const auto drawn = draw_match_picture(picture_of({1242, 375}, {1242, 375}), {});
    const auto query = area_of(drawn, kQueryColour);
    const auto candidate = area_of(drawn, kCandidateColour);
    EXPECT_EQ(drawn.cols, 1242);
    EXPECT_EQ(candidate.x, query.x);
    EXPECT_GT(candidate.y, query.br().y);
}

TEST(MatchPicture, ScalesToTheWidth)
{
    fild::TRenderOptions options;
    options.match_picture_width_px = 1000;
    const auto large = draw_match_picture(picture_of({2000, 1500}, {2000, 1500}), options);
    EXPECT_NEAR(large.cols, 1000, 2);
    EXPECT_NEAR(area_of(large, kQueryColour).width, 497, 4);
    const auto small = draw_match_picture(picture_of({80, 60}, {80, 60}), options);
    EXPECT_NEAR(area_of(small, kQueryColour).width, 497, 4);
}

TEST(MatchPicture, MarksInliersInBothImages)
{
    auto picture = picture_of({640, 480}, {640, 480});
    const auto plain = draw_match_picture(picture, {});
    picture.inliers = {{{600, 100}, {40, 100}}};
    const auto drawn = draw_match_picture(picture, {});
    const auto query = area_of(plain, kQueryColour);
    const auto candidate = area_of(plain, kCandidateColour);
    const auto around = [](const cv::Rect& image, int x, int y)
    { return cv::Rect(image.x + x - 4, image.y + y - 4, 9, 9); };
    EXPECT_GT(differing(drawn(around(query, 600, 100)), kQueryColour), 20);
    EXPECT_GT(differing(drawn(around(candidate, 40, 100)), kCandidateColour), 20);
    EXPECT_GT(differing(drawn(around(query, 630, 100)), kQueryColour), 5) << "the line";
    EXPECT_EQ(differing(drawn(around(query, 500, 100)), kQueryColour), 0) << "before the line";
    EXPECT_EQ(differing(drawn(around(query, 630, 120)), kQueryColour), 0) << "below the line";
}

TEST(MatchPicture, ColoursInliersFromTopToBottom)
{
    auto picture = picture_of({640, 480}, {640, 480});
    picture.inliers = {{{300, 10}, {300, 10}}, {{300, 470}, {300, 470}}};
    const auto drawn = draw_match_picture(picture, {});
    const auto query = area_of(drawn, kQueryColour);
    const auto upper = drawn.at<cv::Vec3b>(query.y + 10, query.x + 300);
    const auto lower = drawn.at<cv::Vec3b>(query.y + 470, query.x + 300);
    EXPECT_GT(upper[0], upper[1]) << "blue";
    EXPECT_GT(lower[1], lower[0] + 100) << "green";
}

TEST(MatchPicture, StaysReadableWith600Inliers)
{
    auto picture = picture_of({640, 480}, {640, 480});
    picture.inliers = grid_of_pairs({640, 480}, 25);
    fild::TRenderOptions options;
    const auto drawn = draw_match_picture(picture, options);
    const auto query = area_of(drawn, kQueryColour);
    const auto untouched = query.area() - differing(drawn(query), kQueryColour);
    EXPECT_GT(untouched, 0.5 * query.area()) << "more than half of the image is to be seen";
    options.max_match_lines = 100000;
    const auto crowded = draw_match_picture(picture, options);
    EXPECT_GT(differing(crowded(query), kQueryColour), differing(drawn(query), kQueryColour));
}

TEST(MatchPicture, DrawsOtherMatchesGrey)
{
    auto picture = picture_of({640, 480}, {640, 480});
    picture.rejected = {{{300, 240}, {100, 40}}};
    const auto drawn = draw_match_picture(picture, {});
    const auto query = area_of(drawn, kQueryColour);
    EXPECT_EQ(drawn.at<cv::Vec3b>(query.y + 240, query.x + 300), cv::Vec3b(190, 190, 190));
}

TEST(MatchPicture, HasACaption)
{
    const auto drawn = draw_match_picture(picture_of({640, 480}, {640, 480}), {});
    const auto query = area_of(drawn, kQueryColour);
    const cv::Vec3b white(255, 255, 255);
    EXPECT_GT(differing(drawn.rowRange(0, query.y), white), 500) << "frames and times";
    EXPECT_GT(differing(drawn.rowRange(query.br().y, drawn.rows), white), 500) << "numbers";
}

TEST(MatchPicture, BearsTinyImagesAndPixelsOutside)
{
    auto picture = picture_of({1, 1}, {1, 1});
    picture.inliers = {{{-50, -50}, {1e4F, 1e4F}}};
    EXPECT_FALSE(draw_match_picture(picture, {}).empty());
}

TEST(MatchPicture, RefusesAMissingImageOrCandidate)
{
    auto picture = picture_of({8, 8}, {8, 8});
    picture.verdict.candidate.reset();
    EXPECT_THROW(draw_match_picture(picture, {}), std::invalid_argument);
    picture = picture_of({8, 8}, {8, 8});
    picture.candidate_image.release();
    EXPECT_THROW(draw_match_picture(picture, {}), std::invalid_argument);
}

/** Two cameras side by side, a metre apart, that look the same way. */
fild::CameraPair camera_pair(const cv::Size& size)
{
    fild::CameraModel camera;
    camera.width = size.width;
    camera.height = size.height;
    camera.fx = camera.fy = size.width;
    camera.cx = (size.width - 1) / 2.0;
    camera.cy = (size.height - 1) / 2.0;
    fild::RigidTransform candidate_from_query;
    candidate_from_query.translation = {1, 0, 0};
    return {camera, camera, candidate_from_query};
}

TEST(MatchPicture3d, StandsBothImagesInTheScene)
{
    const cv::Size size(320, 240);
    auto picture = picture_of(size, size);
    const auto plain = draw_match_picture_3d(picture, camera_pair(size), {});
    EXPECT_EQ(plain.cols, 1400);
    const auto query = area_of(plain, kQueryColour);
    const auto candidate = area_of(plain, kCandidateColour);
    EXPECT_GT(query.area(), plain.total() / 100);
    EXPECT_GT(candidate.area(), plain.total() / 100);
    EXPECT_EQ((query & candidate).area(), 0) << "none hides the other";

    picture.inliers = grid_of_pairs(size, 4);
    const auto drawn = draw_match_picture_3d(picture, camera_pair(size), {});
    cv::Mat differs;
    cv::compare(drawn.reshape(1), plain.reshape(1), differs, cv::CMP_NE);
    EXPECT_GT(cv::countNonZero(differs), 2000) << "lines between matches";
}

TEST(MatchPicture3d, SeesCamerasThatLookAtEachOther)
{
    const cv::Size size(320, 240);
    auto cameras = camera_pair(size);
    cameras.candidate_from_query.rotation = {-1, 0, 0, 0, 1, 0, 0, 0, -1};
    cameras.candidate_from_query.translation = {0, 0, 5};
    const auto drawn = draw_match_picture_3d(picture_of(size, size), cameras, {});
    EXPECT_GT(area_of(drawn, kQueryColour).area() + area_of(drawn, kCandidateColour).area(), 1000);
}

TEST(MatchPicture3d, BearsCamerasAtOnePlace)
{
    const cv::Size size(320, 240);
    auto cameras = camera_pair(size);
    cameras.candidate_from_query = {};
    EXPECT_FALSE(draw_match_picture_3d(picture_of(size, size), cameras, {}).empty());
}

TEST(MatchPicture3d, RefusesWhatIsNoPinholeOrNoPose)
{
    const cv::Size size(320, 240);
    auto cameras = camera_pair(size);
    cameras.query.fx = 0;
    EXPECT_THROW(draw_match_picture_3d(picture_of(size, size), cameras, {}), std::invalid_argument);
    cameras = camera_pair(size);
    cameras.candidate_from_query.translation[0] = std::numeric_limits<double>::infinity();
    EXPECT_THROW(draw_match_picture_3d(picture_of(size, size), cameras, {}), std::invalid_argument);
}

}  // namespace
