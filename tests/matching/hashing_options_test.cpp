// SPDX-License-Identifier: BSD-3-Clause
#include "fild/matching/hashing_options.h"

#include "message_of.h"

namespace
{
using fild::testing::message_of;
using ::testing::HasSubstr;

TEST(HashingOptions, DefaultsAreValid)
{
    EXPECT_NO_THROW(fild::THashingOptions().check());
}

TEST(HashingOptions, TakeMultiplesOf32Only)
{
    fild::THashingOptions options;
    for (const int bits : {32, 96, 256})
    {
        options.bits = bits;
        EXPECT_NO_THROW(options.check());
    }
    options.bits = 100;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { options.check(); }),
                HasSubstr("bits=100 is not a multiple of 32"));
}

TEST(HashingOptions, BoundTheRatio)
{
    fild::THashingOptions options;
    options.ratio = 1.1;
    EXPECT_THAT(message_of<std::invalid_argument>([&] { options.check(); }),
                HasSubstr("ratio=1.1 outside"));
}

}  // namespace
