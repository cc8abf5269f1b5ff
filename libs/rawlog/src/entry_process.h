// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "entry_message.h"
#include "fild/core/trial_process.h"

#include <mrpt/serialization/CArchive.h>

#include <deque>
#include <optional>
#include <string>
#include <sys/types.h>

namespace fild
{
/** The bytes of one entry; what was read is freed. Not thread-safe: one caller at a time. */
class EntryBytes : public mrpt::serialization::CArchive
{
 public:
    void append(std::string part) { parts_.push_back(std::move(part)); }

 private:
    std::size_t read(void* target, std::size_t count) override;
    std::size_t write(const void* source, std::size_t count) override;

    std::deque<std::string> parts_;
    std::size_t read_of_first_ = 0;
};

/** What follows in a rawlog. */
struct NextEntry
{
    EntryMessageKind kind = EntryMessageKind::end;  ///< all but bytes
    EntryBytes bytes;  ///< of an entry
    std::string reason;  ///< of a failure, in one line; or the unknown object
};

/** A process that tries each entry of a rawlog before it is let in here: see send_entries(). It is
 *  a fork of this one, without its open files and its terminal. It ends with this object, or with
 *  this process, whichever way that ends. When it waits for a lock (see kIdleSeconds), another
 *  takes its place at the same entry. Not thread-safe: one caller at a time. */
class EntryProcess
{
 public:
    /** \throw std::runtime_error when no process can be started. */
    EntryProcess(std::string rawlog, std::size_t max_entry_bytes, int idle_seconds = kIdleSeconds);
    EntryProcess(const EntryProcess&) = delete;
    EntryProcess& operator=(const EntryProcess&) = delete;
    ~EntryProcess();

    /** Waits for the next entry, the end, or the first failure, after which nothing follows. */
    NextEntry next();

    /** Bytes of the file, as stored, consumed up to the entry that next() gave last. */
    std::uint64_t stored_bytes_read() const { return stored_bytes_read_; }

 private:
    void start();
    void stop();

    /** Passes over `entries` entries, which were given before. None when the process waits for a
     *  lock. */
    std::optional<NextEntry> receive_after(std::size_t entries);
    std::optional<NextEntry> receive_entry();
    bool receive(void* target, std::size_t count);
    std::string reason_of_its_end();

    std::string rawlog_;
    std::size_t max_entry_bytes_;
    int idle_seconds_;
    struct Child
    {
        int pipe = -1;
        pid_t id = -1;
        bool is_stuck = false;
    };
    Child child_;
    std::size_t entries_given_ = 0;
    std::uint64_t stored_bytes_read_ = 0;
};

}  // namespace fild
