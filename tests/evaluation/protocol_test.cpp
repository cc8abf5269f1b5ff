// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/protocol.h"

#include "message_of.h"

namespace
{
using ::testing::HasSubstr;

TEST(Protocol, ReadsItsWords)
{
    EXPECT_EQ(fild::parse_protocol("exact").kind, fild::Protocol::Kind::exact);
    EXPECT_EQ(fild::parse_protocol("window:10").kind, fild::Protocol::Kind::window);
    EXPECT_EQ(fild::parse_protocol("window:10").window, 10U);
    EXPECT_EQ(fild::parse_protocol("radius:2.5").kind, fild::Protocol::Kind::radius);
    EXPECT_DOUBLE_EQ(fild::parse_protocol("radius:2.5").radius, 2.5);
    EXPECT_DOUBLE_EQ(fild::parse_protocol("radius:2.5,4").doubtful_radius, 4);
    for (const std::string word : {"exact", "window:10", "radius:2.5", "radius:2.5,4"})
        EXPECT_EQ(fild::to_word(fild::parse_protocol(word)), word);
}

TEST(Protocol, RefusesOtherWords)
{
    for (const std::string word : {"",
                                   "exactly",
                                   "window",
                                   "window:",
                                   "window:0",
                                   "window:-1",
                                   "window:1.5",
                                   "radius:0",
                                   "radius:-1",
                                   "radius:x",
                                   "radius:2,",
                                   "radius:2,1",
                                   "radius:2,3,4",
                                   "exact:1",
                                   "Window:10"})
        EXPECT_THAT(
            fild::testing::message_of<std::invalid_argument>([&] { fild::parse_protocol(word); }),
            HasSubstr("'" + word + "' is no protocol"));
}

TEST(Protocol, SaysItsRule)
{
    EXPECT_THAT(fild::rule_of(fild::parse_protocol("window:10")), HasSubstr("at most 10 frames"));
    EXPECT_THAT(fild::rule_of(fild::parse_protocol("radius:2.5")),
                HasSubstr("at most 2.5 m and 45 degrees apart"));
}

}  // namespace
