// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>

namespace fild
{
/** A trial that waits for a lock for longer waits without end: for a thread that is not in the
 *  fork. */
constexpr int kIdleSeconds = 6;

/** How much a trial may take. */
struct TrialLimits
{
    std::size_t bytes = 0;  ///< of memory, beyond what the process has when it begins
    int seconds = 0;  ///< of computing, not of waiting
    int idle_seconds = kIdleSeconds;  ///< of waiting for a lock, after which it is begun anew
};

/** To be called first in a fork that tries what may crash it: no files but `kept_descriptor`, which
 *  becomes the number that is returned, nothing printed, none of the program's signal handlers, no
 *  core file. It does not end by the signals that ask the program to. */
int become_trial_process(int kept_descriptor);

/** Bounds the memory that this process takes from now on: more is refused by the system.
 *  Does nothing with the sanitizers. */
void limit_memory(std::size_t more_bytes);

/** Whether `ulimit -v` leaves this process less than `more_bytes`. */
bool system_grants_less(std::size_t more_bytes);

/** The system ends this process when it computes for longer from now on. A later call begins anew.
 *  */
void limit_computing(int seconds);

/** Waits for a child process. \return what ended it, such as "signal 11"; empty: it ended by
 *  itself, with status 0; "an unknown reason" where the program ignores SIGCHLD or waits for all
 *  children. */
std::string reason_of_end(pid_t process);

/** Waits until something can be read from a pipe whose other end a child process holds, or that end
 *  is closed. \return false: the child has waited for a lock for `idle_seconds`, and computed
 *  nothing; a file that is slow to come, over a network for instance, does not count. */
bool wait_for_pipe(int pipe, pid_t process, int idle_seconds);

/** How a trial ended. Value type. */
struct TrialOutcome
{
    std::string crash;  ///< why the task must not be done here; empty: it ended by itself
    std::optional<std::string> error;  ///< text of the exception that it threw
    std::string result;  ///< what it returned
};

/** Runs a task in a fork of this process, for libraries that crash or take all memory on a bad file
 *  because they trust what they read. As after any fork, locks that other threads hold at that
 *  moment stay locked in it; a trial that waits for one is ended and begun anew, twice.
 *
 *  A task that threw must not be done here: a library that is refused memory may report whatever it
 *  likes, and would be granted that memory here.
 *  \param task  a std::bad_alloc, or OpenCV's, counts as a crash; where `ulimit -v` grants less
 *  memory than `limits.bytes`, it is an error.
 *  \throw std::runtime_error when no process can be started. */
TrialOutcome run_in_trial(const std::function<std::string()>& task, const TrialLimits& limits);

}  // namespace fild
