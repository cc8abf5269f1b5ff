// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.h"

#include <csignal>
#include <initializer_list>

namespace fild
{
namespace
{
volatile std::sig_atomic_t stop_asked = 0;  // a signal handler can reach nothing but a global

void ask_to_stop(int)
{
    stop_asked = 1;
}
}  // namespace

void catch_interruption()
{
    struct sigaction action = {};
    action.sa_handler = ask_to_stop;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

bool interrupted()
{
    return stop_asked != 0;
}

}  // namespace fild
