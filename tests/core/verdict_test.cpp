// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/verdict.h"

#include <gtest/gtest.h>

#include <set>

namespace
{
TEST(Rejection, HasAWordOfItsOwnForEveryReason)
{
    std::set<std::string> words;
    for (const auto rejection : fild::all_rejections()) words.insert(to_word(rejection));
    EXPECT_EQ(words.size(), fild::all_rejections().size());
    EXPECT_EQ(to_word(fild::Rejection::none), "");
    EXPECT_EQ(to_word(fild::Rejection::too_few_inliers), "too_few_inliers");
}

TEST(Rejection, IsUnusableForTheFirstFourReasons)
{
    const auto& all = fild::all_rejections();
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(fild::is_unusable(all[i]), i >= 1 && i <= 4) << to_word(all[i]);
}

TEST(FrameVerdict, IsAcceptedOnlyWithoutARejection)
{
    fild::FrameVerdict verdict;
    EXPECT_TRUE(verdict.accepted());
    verdict.rejection = fild::Rejection::no_model;
    EXPECT_FALSE(verdict.accepted());
}

}  // namespace
