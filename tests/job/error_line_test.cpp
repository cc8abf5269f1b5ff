// SPDX-License-Identifier: BSD-3-Clause
#include "fild/job/error_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>

namespace
{
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string line_of(const std::string& text)
{
    return fild::error_line(std::runtime_error(text));
}

TEST(ErrorLine, IsTheTextItself)
{
    EXPECT_EQ(line_of("cannot read a.rawlog"), "cannot read a.rawlog");
    EXPECT_EQ(line_of(""), "");
}

TEST(ErrorLine, HasNoLineBreaks)
{
    EXPECT_EQ(line_of("OpenCV: error\n  > Expected\r\n\t'x'\n"), "OpenCV: error > Expected 'x'");
}

TEST(ErrorLine, LeavesOutWhatMrptPutsAroundTheMessage)
{
    EXPECT_EQ(line_of("\n\n ==== MRPT exception ====\nMessage:  cannot make a buffer\n"
                      "Location:  CFBORender.cpp:12: [render] \nCall stack backtrace:\n[0] main\n"),
              "cannot make a buffer");
    EXPECT_EQ(line_of("no map pictures: ==== MRPT exception ====\nMessage: no\nLocation: x\n"),
              "no map pictures: no");
}

TEST(ErrorLine, SaysThatMemoryRanOutAndWhatToDo)
{
    const auto is_about_memory = AllOf(HasSubstr("out of memory"), HasSubstr("ulimit -v"));
    EXPECT_THAT(fild::error_line(std::bad_alloc()), is_about_memory);
    EXPECT_THAT(line_of("std::bad_alloc"), is_about_memory);
    EXPECT_THAT(line_of("OpenCV(4.6.0) alloc.cpp:73: error: (-4:Insufficient memory) Failed to "
                        "allocate 1234 bytes in function 'OutOfMemoryError'\n"),
                is_about_memory);
}

TEST(ErrorLine, LeavesOutTheMiddleOfAnEndlessText)
{
    const auto line = line_of("begin " + std::string(200000, 'x') + " end");
    EXPECT_LT(line.size(), 8000U);
    EXPECT_THAT(line, AllOf(HasSubstr("begin xx"), HasSubstr("xx end"), Not(HasSubstr("\n"))));
}

}  // namespace
