// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
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

    std::vector<std::thread> helpers;
    try
    {
        for (std::size_t t = 1; t < thread_count(num_threads, count); ++t)
            helpers.emplace_back(work);
    }
    catch (const std::system_error&)  // no more threads to be had: those there are do the work
    {
    }
    work();
    for (auto& helper : helpers) helper.join();
    for (const auto& error : errors)
        if (error) std::rethrow_exception(error);
}

}  // namespace fild
