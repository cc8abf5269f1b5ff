// SPDX-License-Identifier: BSD-3-Clause
#include "fild/job/interruption.h"

#include <atomic>
#include <csignal>
#include <ctime>
#include <initializer_list>

namespace fild
{
namespace
{
constexpr std::time_t kSecondsOfPatience = 2;

// A signal handler can reach nothing but globals, and only lock-free ones; threads read them too.
constexpr std::time_t kNotAsked = -1;
std::atomic<std::time_t> first_asked{kNotAsked};
static_assert(std::atomic<std::time_t>::is_always_lock_free);

/** Calls only what POSIX allows in a signal handler. */
void ask_to_stop(int signal)
{
    const auto now = std::time(nullptr);
    auto first = kNotAsked;
    if (first_asked.compare_exchange_strong(first, now)) return;
    if (now - first < kSecondsOfPatience) return;
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}
}  // namespace

void catch_interruption()
{
    struct sigaction action = {};
    action.sa_handler = ask_to_stop;
    action.sa_flags = SA_RESTART;  // else a read that it interrupts looks like a damaged file
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        struct sigaction before = {};
        sigaction(signal, nullptr, &before);
        const bool is_nohup = signal == SIGHUP && before.sa_handler == SIG_IGN;
        if (!is_nohup) sigaction(signal, &action, nullptr);
    }
}

bool interrupted()
{
    return first_asked != kNotAsked;
}

void throw_if_interrupted()
{
    if (interrupted()) throw Interrupted();
}

}  // namespace fild
