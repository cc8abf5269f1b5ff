// SPDX-License-Identifier: BSD-3-Clause
#include "fild/render/render_options.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
using Indices = std::vector<std::size_t>;

Indices choose(int limit, fild::PictureChoice choice, const Indices& inliers)
{
    std::vector<fild::FrameVerdict> loops;
    for (const auto count : inliers)
    {
        loops.emplace_back();
        loops.back().inliers = count;
    }
    fild::TRenderOptions options;
    options.max_match_pictures = limit;
    options.match_picture_choice = choice;
    return choose_match_pictures(loops, options);
}

TEST(ChooseMatchPictures, TakesAllWithinTheLimit)
{
    EXPECT_EQ(choose(3, fild::PictureChoice::weakest, {5, 4, 3}), (Indices{0, 1, 2}));
    EXPECT_EQ(choose(3, fild::PictureChoice::spread, {}), Indices{});
    EXPECT_EQ(choose(0, fild::PictureChoice::spread, {5}), Indices{});
}

TEST(ChooseMatchPictures, SpreadsFromTheFirstToTheLast)
{
    EXPECT_EQ(choose(3, fild::PictureChoice::spread, {1, 1, 1, 1, 1, 1, 1}), (Indices{0, 3, 6}));
    EXPECT_EQ(choose(1, fild::PictureChoice::spread, {1, 1, 1}), Indices{1});
}

TEST(ChooseMatchPictures, SortsByInliersAndAnswersInOrder)
{
    const Indices inliers = {50, 20, 90, 20, 70};
    EXPECT_EQ(choose(2, fild::PictureChoice::weakest, inliers), (Indices{1, 3}));
    EXPECT_EQ(choose(2, fild::PictureChoice::strongest, inliers), (Indices{2, 4}));
    EXPECT_EQ(choose(2, fild::PictureChoice::first, inliers), (Indices{0, 1}));
}

TEST(ChooseMatchPictures, TakesNoneWhenNothingIsDrawn)
{
    fild::TRenderOptions options;
    options.enabled = false;
    EXPECT_EQ(choose_match_pictures(std::vector<fild::FrameVerdict>(3), options), Indices{});
}

TEST(RenderOptions, BoundTheNumberOfPictures)
{
    fild::TRenderOptions options;
    EXPECT_NO_THROW(options.check());
    options.max_match_pictures = -1;
    EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
