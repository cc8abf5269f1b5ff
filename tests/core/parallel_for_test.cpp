// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/parallel_for.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace
{
TEST(ParallelFor, VisitsEveryIndexOnceWithAnyNumberOfThreads)
{
    for (const int threads : {0, 1, 2, 7})
        for (const std::size_t count : {0U, 1U, 3U, 1000U})
        {
            std::vector<int> visits(count, 0);
            fild::parallel_for(threads, count, [&](std::size_t i) { ++visits[i]; });
            EXPECT_EQ(visits, std::vector<int>(count, 1)) << threads << " threads, " << count;
        }
}

TEST(ParallelFor, RethrowsTheFirstErrorByIndex)
{
    for (const int threads : {1, 2, 4}) try
        {
            fild::parallel_for(threads,
                               100,
                               [](std::size_t i)
                               {
                                   if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
                               });
            ADD_FAILURE() << "no error came through";
        }
        catch (const std::runtime_error& error)
        {
            EXPECT_STREQ(error.what(), "7");
        }
}

}  // namespace
