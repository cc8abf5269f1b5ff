// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace fild
{
namespace
{
std::size_t thread_count(int num_threads, std::size_t count)
{
    const auto wanted = num_threads > 0 ? static_cast<std::size_t>(num_threads)
                                        : std::max(1U, std::thread::hardware_concurrency());
    return std::min(wanted, count);
}
}  // namespace

void parallel_for(int num_threads, std::size_t count, const std::function<void(std::size_t)>& body)
{
    std::atomic<std::size_t> next{0};
    std::vector<std::exception_ptr> errors(count);
    const auto work = [&]
    {
        for (std::size_t i = next++; i < count; i = next++)
        {
            try
            {
                body(i);
            }
            catch (...)  // handed to the caller below
            {
                errors[i] = std::current_exception();
            }
        }
    };

    const auto threads = thread_count(num_threads, count);
    std::vector<std::thread> helpers;
    helpers.reserve(threads);  // now: with threads running nothing may throw past them
    try
    {
        while (helpers.size() + 1 < threads) helpers.emplace_back(work);
    }
    catch (const std::system_error&)  // no more threads to be had: those there are do the work
    {
    }
    catch (const std::bad_alloc&)  // likewise
    {
    }
    work();
    for (auto& helper : helpers) helper.join();
    for (const auto& error : errors)
        if (error) std::rethrow_exception(error);
}

}  // namespace fild
