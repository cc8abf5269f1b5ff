// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/utf8.h"

#include <gtest/gtest.h>

namespace
{
using fild::as_utf8;

TEST(AsUtf8, LeavesValidTextAsItIs)
{
    for (const std::string text :
         {"", "CAMERA1", "K\xC3\xA4mera", "\xE5\x89\x8D", "\xF0\x9F\x93\xB7"})
        EXPECT_EQ(as_utf8(text), text);
}

TEST(AsUtf8, TakesOtherBytesForLatin1)
{
    EXPECT_EQ(as_utf8("K\xE4mera"), "K\xC3\xA4mera");
    EXPECT_EQ(as_utf8("\xFF"), "\xC3\xBF");
}

TEST(AsUtf8, ConvertsWhatOnlyLooksLikeUtf8)
{
    for (const std::string text : {"\x80",  // inside a character
                                   "\xC0\x80",  // longer than need be
                                   "\xC1\xBF",
                                   "\xE0\x80\x80",
                                   "\xED\xA0\x80",  // a surrogate
                                   "\xF0\x80\x80\x80",
                                   "\xF4\x90\x80\x80",  // above U+10FFFF
                                   "\xF5\x80\x80\x80",
                                   "\xC3",  // cut off
                                   "\xE5\x89",
                                   "\xC3(",
                                   "\xE5\x89("})
    {
        EXPECT_NE(as_utf8(text), text);
        EXPECT_EQ(as_utf8(as_utf8(text)), as_utf8(text)) << "is valid";
    }
}

}  // namespace
