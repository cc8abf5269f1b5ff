// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.h"

#include <atomic>
#include <csignal>
#include <ctime>
#include <initializer_list>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr std::time_t kSecondsOfPatience = 2;

// A signal handler can reach nothing but globals, and only lock-free ones.
volatile std::sig_atomic_t stop_asked = 0;
std::atomic<std::time_t> first_asked{0};

/** Calls only what POSIX allows in a signal handler. */
void ask_to_stop(int signal)
{
    const auto now = std::time(nullptr);
    if (stop_asked != 0 && now - first_asked >= kSecondsOfPatience)
    {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    if (stop_asked == 0) first_asked = now;
    stop_asked = 1;
}
}  // namespace

void catch_interruption()
{
    struct sigaction action = {};
    action.sa_handler = ask_to_stop;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

bool interrupted()
{
    return stop_asked != 0;
}

void throw_if_interrupted()
{
    if (interrupted()) throw std::runtime_error("interrupted");
}

}  // namespace fild
