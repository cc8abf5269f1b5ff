// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/trial_process.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <new>
#include <optional>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace fild
{
namespace
{
constexpr int kKeptDescriptor = 3;  // the first number behind the standard streams
constexpr int kAttempts = 3;  // of a process that waits for a lock nobody holds

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasSanitizer = true;  // its own memory would count
#else
constexpr bool kHasSanitizer = false;
#endif

void set_signals()
{
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGTRAP, SIGSYS})
        std::signal(signal, SIG_DFL);
    // It ends with the process that started it, which is asked by the same signals.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE})
        std::signal(signal, SIG_IGN);
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

void set_limit(__rlimit_resource resource, rlim_t value)
{
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0) return;
    limit.rlim_cur = std::min(value, limit.rlim_max);
    setrlimit(resource, &limit);
}

/** A column of /proc/self/statm, in bytes; 0 when the system does not tell. */
std::size_t statm_bytes(std::size_t column)
{
    std::ifstream statistics("/proc/self/statm");
    std::array<std::size_t, 6> pages{};
    for (auto& each : pages) statistics >> each;
    return statistics ? pages.at(column) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/** Memory of its own that this process may write to. */
std::size_t data_bytes()
{
    return statm_bytes(5);
}

/** What comes before the text that a trial writes to its pipe. The exit status would not do: a
 *  program that ignores SIGCHLD never learns it. */
struct ReportHeader
{
    enum class Kind : std::uint8_t
    {
        returned,
        threw,
        out_of_memory
    };
    Kind kind = Kind::returned;
    std::size_t text_bytes = 0;
};

/** What a trial has to tell. Value type. */
struct Report
{
    ReportHeader::Kind kind = ReportHeader::Kind::returned;
    std::string text;  ///< that it returned, or of its exception
};

Report report_of(const std::function<std::string()>& task)
{
    using Kind = ReportHeader::Kind;
    try
    {
        return {Kind::returned, task()};
    }
    catch (const std::bad_alloc&)
    {
        return {Kind::out_of_memory, ""};
    }
    catch (const cv::Exception& error)
    {
        if (error.code == cv::Error::StsNoMem) return {Kind::out_of_memory, ""};
        return {Kind::threw, error.what()};
    }
    catch (const std::exception& error)
    {
        return {Kind::threw, error.what()};
    }
}

bool write_all(int pipe, const void* data, std::size_t size)
{
    const auto* rest = static_cast<const char*>(data);
    while (size > 0)
    {
        const auto count = ::write(pipe, rest, size);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        rest += count;
        size -= static_cast<std::size_t>(count);
    }
    return true;
}

std::string read_all(int pipe)
{
    std::string all;
    std::array<char, 65536> part{};
    for (;;)
    {
        const auto count = ::read(pipe, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return all;
        all.append(part.data(), static_cast<std::size_t>(count));
    }
}

[[noreturn]] void try_task(const std::function<std::string()>& task,
                           const TrialLimits& limits,
                           int pipe)
{
    become_trial_process(pipe);
    limit_memory(limits.bytes);
    limit_computing(limits.seconds);
    const auto report = report_of(task);
    const ReportHeader header{report.kind, report.text.size()};
    const bool written = write_all(kKeptDescriptor, &header, sizeof(header)) &&
                         write_all(kKeptDescriptor, report.text.data(), report.text.size());
    _exit(written ? 0 : 1);  // not the program's destructors
}

/** What a process has done so far. Value type. */
struct Activity
{
    bool waits_for_lock = false;
    unsigned long ticks = 0;  ///< of computing
};

/** Whether a process that sleeps waits for another thread, and not for a file or a clock. True when
 *  the system does not tell. */
bool sleeps_for_thread(pid_t process)
{
    std::ifstream file("/proc/" + std::to_string(process) + "/wchan");
    std::string place;  // in the kernel
    file >> place;
    return place.empty() || place == "0" || place.rfind("futex", 0) == 0;
}

/** None when the system does not tell. */
std::optional<Activity> activity_of(pid_t process)
{
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto name_end = text.rfind(')');  // the name may hold anything
    if (name_end == std::string::npos) return std::nullopt;
    std::istringstream fields(text.substr(name_end + 1));
    std::string state;
    std::string unused;
    unsigned long user_ticks = 0;
    unsigned long system_ticks = 0;
    fields >> state;
    constexpr int kBetweenStateAndTimes = 10;
    for (int i = 0; i < kBetweenStateAndTimes; ++i) fields >> unused;
    if (!(fields >> user_ticks >> system_ticks)) return std::nullopt;
    return Activity{state == "S" && sleeps_for_thread(process), user_ticks + system_ticks};
}

/** Whether a child that got on as `before` says has not done so since. */
bool is_idle(const std::optional<Activity>& before, const std::optional<Activity>& now)
{
    return before && now && now->waits_for_lock && now->ticks == before->ticks;
}

/** A trial that runs, and the pipe that is closed when it ends. Value type. */
struct Trial
{
    pid_t process = -1;
    int pipe = -1;
};

Trial start(const std::function<std::string()>& task, const TrialLimits& limits)
{
    const auto cannot_start = [](int error_number)
    {
        return std::runtime_error("cannot start a process that tries a file: " +
                                  std::generic_category().message(error_number));
    };
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw cannot_start(errno);
    const auto process = ::fork();
    if (process == 0) try_task(task, limits, ends[1]);
    const int error_number = errno;
    ::close(ends[1]);
    if (process > 0) return {process, ends[0]};
    ::close(ends[0]);
    throw cannot_start(error_number);
}

/** None: the trial ended before it had told all. */
std::optional<Report> read_report(int pipe)
{
    auto text = read_all(pipe);
    ReportHeader header;
    if (text.size() < sizeof(header)) return std::nullopt;
    std::memcpy(&header, text.data(), sizeof(header));
    text.erase(0, sizeof(header));
    if (text.size() != header.text_bytes) return std::nullopt;
    return Report{header.kind, std::move(text)};
}

TrialOutcome to_outcome(Report report, const TrialLimits& limits)
{
    switch (report.kind)
    {
        case ReportHeader::Kind::returned:
            return {"", std::nullopt, std::move(report.text)};
        case ReportHeader::Kind::threw:
            return {"", std::move(report.text), ""};
        case ReportHeader::Kind::out_of_memory:
            break;
    }
    if (system_grants_less(limits.bytes))
        return {"", "the system grants this process too little memory (ulimit -v)", ""};
    return {"more than " + std::to_string(limits.bytes >> 20U) + " MB of memory", std::nullopt, ""};
}

/** None: the trial waited for a lock. */
std::optional<TrialOutcome> end_of(const Trial& trial, const TrialLimits& limits)
{
    const bool has_ended = wait_for_pipe(trial.pipe, trial.process, limits.idle_seconds);
    auto report = has_ended ? read_report(trial.pipe) : std::nullopt;
    ::close(trial.pipe);
    if (!has_ended) ::kill(trial.process, SIGKILL);
    auto reason = reason_of_end(trial.process);
    if (!has_ended) return std::nullopt;
    if (report) return to_outcome(std::move(*report), limits);
    return TrialOutcome{reason.empty() ? "an early exit" : reason, std::nullopt, ""};
}
}  // namespace

int become_trial_process(int kept_descriptor)
{
    set_signals();
    set_limit(RLIMIT_CORE, 0);
    // Locks and pipes of the program are let go.
    if (kept_descriptor != kKeptDescriptor) ::dup2(kept_descriptor, kKeptDescriptor);
    const int nothing = ::open("/dev/null", O_RDWR);
    for (int stream = 0; stream < kKeptDescriptor; ++stream) ::dup2(nothing, stream);
    ::closefrom(kKeptDescriptor + 1);
    return kKeptDescriptor;
}

void limit_memory(std::size_t more_bytes)
{
    if (kHasSanitizer) return;
    rlimit limit{};
    if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
    if (const auto used = data_bytes(); used > 0)
        set_limit(RLIMIT_DATA, std::min<rlim_t>(limit.rlim_cur, used + more_bytes));
}

bool system_grants_less(std::size_t more_bytes)
{
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return false;
    return statm_bytes(0) + more_bytes > limit.rlim_cur;
}

void limit_computing(int seconds)
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto used = usage.ru_utime.tv_sec + usage.ru_stime.tv_sec;
    set_limit(RLIMIT_CPU, static_cast<rlim_t>(used + seconds));
}

std::string reason_of_end(pid_t process)
{
    int status = 0;
    pid_t ended = -1;
    do ended = ::waitpid(process, &status, 0);
    while (ended < 0 && errno == EINTR);
    if (ended != process) return "an unknown reason";  // the program around us waits for all
    if (WIFEXITED(status))
        return WEXITSTATUS(status) == 0 ? "" : "status " + std::to_string(WEXITSTATUS(status));
    if (WTERMSIG(status) == SIGXCPU) return "too long computing";
    return "signal " + std::to_string(WTERMSIG(status));
}

bool wait_for_pipe(int pipe, pid_t process, int idle_seconds)
{
    using Clock = std::chrono::steady_clock;
    constexpr int kLookMilliseconds = 500;
    std::optional<Activity> last;
    auto since = Clock::now();
    for (;;)
    {
        pollfd waited{pipe, POLLIN, 0};
        const int ready = ::poll(&waited, 1, kLookMilliseconds);
        if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
        const auto now = activity_of(process);
        if (!is_idle(last, now)) since = Clock::now();
        if (Clock::now() - since > std::chrono::seconds(idle_seconds)) return false;
        last = now;
    }
}

TrialOutcome run_in_trial(const std::function<std::string()>& task, const TrialLimits& limits)
{
    for (int attempt = 0; attempt < kAttempts; ++attempt)
        if (auto outcome = end_of(start(task, limits), limits)) return *outcome;
    return {"waiting for a lock without end", std::nullopt, ""};
}

}  // namespace fild
