// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/words.h"

#include <gtest/gtest.h>

namespace
{
TEST(CountOf, IsOneThingOrMany)
{
    EXPECT_EQ(fild::count_of(1, "image"), "1 image");
    EXPECT_EQ(fild::count_of(0, "image"), "0 images");
    EXPECT_EQ(fild::count_of(2, "image was", "images were"), "2 images were");
}

TEST(Joined, HasNothingBeforeTheFirstOrBehindTheLast)
{
    EXPECT_EQ(fild::joined({}, ", "), "");
    EXPECT_EQ(fild::joined({"a"}, ", "), "a");
    EXPECT_EQ(fild::joined({"a", "b", "c"}, ", "), "a, b, c");
}

}  // namespace
