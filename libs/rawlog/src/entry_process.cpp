// SPDX-License-Identifier: BSD-3-Clause
#include "entry_process.h"

#include "entry_sender.h"
#include "fild/core/trial_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace fild
{
namespace
{
/** Room for an entry or two, so that neither process waits for the other within one. */
constexpr int kPipeBytes = 1 << 20;
constexpr int kAttempts = 3;  // at one entry

[[noreturn]] void run_sender(const std::string& rawlog, std::size_t max_entry_bytes, int pipe)
{
    const int kept = become_trial_process(pipe);
    try
    {
        send_entries(rawlog, max_entry_bytes, kept);
    }
    catch (const std::exception&)
    {
        _exit(1);
    }
    _exit(0);  // not the program's destructors
}

[[noreturn]] void cannot_start(int error_number)
{
    throw std::runtime_error("cannot start the process that reads the rawlog: " +
                             std::generic_category().message(error_number));
}

NextEntry failure(std::string reason)
{
    NextEntry next;
    next.kind = EntryMessageKind::failure;
    next.reason = std::move(reason);
    return next;
}
}  // namespace

std::size_t EntryBytes::read(void* target, std::size_t count)
{
    for (std::size_t done = 0; done < count;)
    {
        if (parts_.empty()) throw std::runtime_error("the entry ends before its end");
        const auto& first = parts_.front();
        const auto part = std::min(count - done, first.size() - read_of_first_);
        std::memcpy(static_cast<char*>(target) + done, first.data() + read_of_first_, part);
        done += part;
        read_of_first_ += part;
        if (read_of_first_ < first.size()) continue;
        parts_.pop_front();
        read_of_first_ = 0;
    }
    return count;
}

std::size_t EntryBytes::write(const void*, std::size_t)
{
    throw std::logic_error("EntryBytes does not write");
}

EntryProcess::EntryProcess(std::string rawlog, std::size_t max_entry_bytes, int idle_seconds)
    : rawlog_(std::move(rawlog)), max_entry_bytes_(max_entry_bytes), idle_seconds_(idle_seconds)
{
    start();
}

EntryProcess::~EntryProcess()
{
    stop();
}

void EntryProcess::start()
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) cannot_start(errno);
    ::fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);  // where it is refused, the pipe is smaller
    child_.id = ::fork();
    if (child_.id == 0) run_sender(rawlog_, max_entry_bytes_, ends[1]);
    const int error_number = errno;
    ::close(ends[1]);
    child_.pipe = ends[0];
    if (child_.id > 0) return;
    ::close(child_.pipe);
    child_.pipe = -1;
    cannot_start(error_number);
}

void EntryProcess::stop()
{
    ::close(child_.pipe);
    child_.pipe = -1;
    if (child_.id <= 0) return;
    ::kill(child_.id, SIGKILL);
    reason_of_its_end();
}

NextEntry EntryProcess::next()
{
    if (child_.pipe < 0) return failure("the process that reads it has ended");
    auto next = receive_after(0);
    for (int attempt = 1; !next && attempt < kAttempts; ++attempt)
    {
        stop();
        start();
        next = receive_after(entries_given_);
    }
    if (!next) next = failure("the process that reads it waits for a lock without end");
    if (next->kind == EntryMessageKind::entry)
        ++entries_given_;
    else
        stop();
    return std::move(*next);
}

std::optional<NextEntry> EntryProcess::receive_after(std::size_t entries)
{
    auto next = receive_entry();
    for (; entries > 0 && next && next->kind == EntryMessageKind::entry; --entries)
        next = receive_entry();
    return next;
}

std::optional<NextEntry> EntryProcess::receive_entry()
{
    NextEntry next;
    EntryMessageHeader header;
    while (receive(&header, sizeof(header)) && header.length <= kMaxMessageBytes)
    {
        std::string content(header.length, '\0');
        if (!receive(content.data(), content.size())) break;
        stored_bytes_read_ = header.stored_bytes_read;
        next.kind = header.kind;
        if (header.kind == EntryMessageKind::bytes)
        {
            next.bytes.append(std::move(content));
            continue;
        }
        next.reason = std::move(content);
        return next;
    }
    if (child_.is_stuck) return std::nullopt;
    return failure(reason_of_its_end());
}

bool EntryProcess::receive(void* target, std::size_t count)
{
    for (std::size_t done = 0; done < count;)
    {
        child_.is_stuck = !wait_for_pipe(child_.pipe, child_.id, idle_seconds_);
        if (child_.is_stuck) return false;
        const auto got = ::read(child_.pipe, static_cast<char*>(target) + done, count - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        done += static_cast<std::size_t>(got);
    }
    return true;
}

std::string EntryProcess::reason_of_its_end()
{
    const auto reason = reason_of_end(child_.id);
    child_.id = -1;
    if (reason.empty()) return "the process that reads it ended";
    return "reading an entry ended in " + reason + ", as with sizes that are wrong";
}

}  // namespace fild
