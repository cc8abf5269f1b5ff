// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/trial_process.h"

#include "held_lock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace
{
constexpr fild::TrialLimits kLimits{std::size_t{64} << 20U, 1, 1};

fild::TrialOutcome outcome_of(const std::function<std::string()>& task)
{
    return fild::run_in_trial(task, kLimits);
}

std::string crash_of(const std::function<void()>& task)
{
    return outcome_of(
               [&]
               {
                   task();
                   return std::string();
               })
        .crash;
}

TEST(RunInTrial, BringsWhatTheTaskReturns)
{
    std::string large(300000, 'x');
    const auto outcome = outcome_of([&] { return large; });
    EXPECT_EQ(outcome.crash, "");
    EXPECT_EQ(outcome.error, std::nullopt);
    EXPECT_EQ(outcome.result, large);
}

TEST(RunInTrial, BringsTheErrorThatItThrows)
{
    const auto outcome = outcome_of([]() -> std::string { throw std::runtime_error("refused"); });
    EXPECT_EQ(outcome.crash, "");
    EXPECT_EQ(outcome.error, "refused");
}

TEST(RunInTrial, IsNoneWhenTheTaskEndsOrThrows)
{
    EXPECT_EQ(crash_of([] {}), "");
    EXPECT_EQ(crash_of([] { throw std::runtime_error("refused"); }), "");
}

TEST(RunInTrial, NamesTheSignal)
{
    EXPECT_EQ(crash_of([] { std::raise(SIGSEGV); }), "signal " + std::to_string(SIGSEGV));
}

TEST(RunInTrial, BoundsMemory)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizers end the process when memory is out";
#endif
    const auto take = [](std::size_t megabytes)
    { return [=] { std::vector<char>(megabytes << 20U, 'a').swap(*new std::vector<char>); }; };
    EXPECT_EQ(crash_of(take(16)), "");
    EXPECT_EQ(crash_of(take(100)), "more than 64 MB of memory");
}

/** Then it is not the file's fault. */
TEST(RunInTrial, IsNoneWhenTheSystemGrantsLessMemoryThanTheLimit)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizers take more address space than any limit grants";
#endif
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit before{};
    getrlimit(RLIMIT_AS, &before);
    auto limit = before;
    limit.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (32U << 20U);
    ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
    const auto outcome = outcome_of(
        []
        {
            std::vector<char>(std::size_t{200} << 20U, 'a').swap(*new std::vector<char>);
            return std::string();
        });
    setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(outcome.crash, "");
    EXPECT_EQ(outcome.error, "the system grants this process too little memory (ulimit -v)");
}

TEST(RunInTrial, BoundsComputing)
{
    EXPECT_EQ(crash_of(
                  []
                  {
                      for (volatile bool on = true; on;) continue;
                  }),
              "too long computing");
}

TEST(RunInTrial, BeginsAnewWhenTheForkWaitsForALockOfAnotherThread)
{
    std::mutex mutex;
    const fild::testing::HeldLock other(mutex, std::chrono::milliseconds(500));
    EXPECT_EQ(crash_of([&] { const std::lock_guard lock(mutex); }), "");
}

TEST(RunInTrial, EndsATaskThatWaitsForALockWithoutEnd)
{
    std::mutex mutex;
    const std::lock_guard lock(mutex);
    EXPECT_EQ(crash_of([&] { const std::lock_guard again(mutex); }),
              "waiting for a lock without end");
}

TEST(RunInTrial, LetsATaskWaitForASlowFile)
{
    EXPECT_EQ(crash_of([] { std::this_thread::sleep_for(std::chrono::milliseconds(2500)); }), "");
}

TEST(RunInTrial, KnowsTheOutcomeWhenTheProgramIgnoresItsChildren)
{
    auto* const before = std::signal(SIGCHLD, SIG_IGN);
    EXPECT_EQ(crash_of([] {}), "");
    EXPECT_EQ(crash_of([] { throw std::bad_alloc(); }), "more than 64 MB of memory");
    EXPECT_EQ(crash_of([] { std::raise(SIGSEGV); }), "an unknown reason");
    std::signal(SIGCHLD, before);
}

TEST(RunInTrial, CountsAnEarlyExit)
{
    EXPECT_EQ(crash_of([] { std::_Exit(0); }), "an early exit");
}

TEST(RunInTrial, ChangesNothingHere)
{
    int value = 1;
    EXPECT_EQ(crash_of([&] { value = 2; }), "");
    EXPECT_EQ(value, 1);
}

}  // namespace
