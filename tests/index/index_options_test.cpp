// SPDX-License-Identifier: BSD-3-Clause
#include "fild/index/index_options.h"

#include "message_of.h"

namespace
{
using fild::testing::message_of;
using ::testing::HasSubstr;

std::string check_error(const fild::TIndexOptions& options)
{
    return message_of<std::invalid_argument>([&] { options.check(); });
}

TEST(IndexOptions, DefaultsAreValid)
{
    EXPECT_NO_THROW(fild::TIndexOptions().check());
}

TEST(IndexOptions, NameTheFieldOutOfRange)
{
    fild::TIndexOptions options;
    options.links_per_node = 1;
    EXPECT_THAT(check_error(options), HasSubstr("links_per_node=1 outside [2, 200]"));
    options = {};
    options.delay_seconds = -1;
    EXPECT_THAT(check_error(options), HasSubstr("delay_seconds=-1"));
}

TEST(IndexOptions, WantASearchAsWideAsTheAnswer)
{
    fild::TIndexOptions options;
    options.search_width = 5;
    options.candidates = 6;
    EXPECT_THAT(check_error(options), HasSubstr("search_width=5 is below candidates=6"));
    options.backend = fild::IndexBackend::exact;  // has no search width
    EXPECT_NO_THROW(options.check());
}

}  // namespace
