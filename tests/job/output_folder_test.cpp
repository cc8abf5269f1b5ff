// SPDX-License-Identifier: BSD-3-Clause
#include "fild/job/output_folder.h"

#include "message_of.h"
#include "temporary_folder.h"

#include <atomic>
#include <filesystem>
#include <thread>
#include <vector>

namespace
{
using fild::OutputFolder;
using fild::testing::message_of;
using fild::testing::TemporaryFolder;

TEST(OutputFolder, IsMadeAndLeftWithoutALockFile)
{
    const TemporaryFolder parent;
    {
        const OutputFolder folder(parent.path("a/b"));
        EXPECT_EQ(folder.file("x.csv"), parent.path("a/b/x.csv"));
    }
    EXPECT_TRUE(std::filesystem::is_empty(parent.path("a/b")));
}

TEST(OutputFolder, IsForOneRunAtATime)
{
    const TemporaryFolder parent;
    const auto path = parent.path("results");
    {
        const OutputFolder folder(path);
        EXPECT_THAT(message_of<std::runtime_error>([&] { OutputFolder second(path); }),
                    ::testing::HasSubstr("another run is writing into " + path));
    }
    EXPECT_NO_THROW(OutputFolder third(path));
}

// A run that ends removes its lock file, maybe after another one has opened it.
TEST(OutputFolder, IsNeverForTwoRunsThatBeginAndEnd)
{
    const TemporaryFolder parent;
    const auto path = parent.path("results");
    std::atomic<int> inside{0};
    std::atomic<int> most{0};
    const auto run_often = [&]
    {
        for (int i = 0; i < 3000; ++i) try
            {
                const OutputFolder folder(path);
                const int now = ++inside;
                if (now > most) most = now;
                std::this_thread::yield();
                --inside;
            }
            catch (const std::runtime_error&)
            {
                // The other one is writing.
            }
    };
    std::vector<std::thread> runs;
    for (int i = 0; i < 4; ++i) runs.emplace_back(run_often);
    for (auto& run : runs) run.join();
    EXPECT_EQ(most, 1);
}

}  // namespace
