// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

namespace fild::testing
{
/** Another thread holds a mutex: from the end of the constructor on, for some time. */
class HeldLock
{
 public:
    HeldLock(std::mutex& mutex, std::chrono::milliseconds time)
    {
        std::promise<void> is_locked;
        auto locked = is_locked.get_future();
        thread_ = std::thread(
            [&mutex, time](std::promise<void> done)
            {
                const std::lock_guard lock(mutex);
                done.set_value();
                std::this_thread::sleep_for(time);
            },
            std::move(is_locked));
        locked.wait();
    }
    HeldLock(const HeldLock&) = delete;
    HeldLock& operator=(const HeldLock&) = delete;
    ~HeldLock() { thread_.join(); }

 private:
    std::thread thread_;
};
}  // namespace fild::testing
