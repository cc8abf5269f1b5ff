// SPDX-License-Identifier: BSD-3-Clause
#include "entry_sender.h"

#include "entry_message.h"
#include "fild/core/trial_process.h"
#include "gz_archive.h"
#include "mrpt_reason.h"

#include <mrpt/obs/CRawlog.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <unistd.h>
#include <vector>

namespace fild
{
namespace
{
constexpr int kSecondsPerEntry = 10;
constexpr std::size_t kMaxStackBytes = std::size_t{256} << 10U;
constexpr std::size_t kForReading = std::size_t{8} << 20U;  // buffers of zlib's and ours

/** Writes messages to the pipe; ends the process when nobody reads them any more. */
class MessagePipe
{
 public:
    explicit MessagePipe(int pipe) : pipe_(pipe) {}

    void send(EntryMessageKind kind,
              std::uint64_t stored_bytes_read,
              const void* content = nullptr,
              std::size_t length = 0) const
    {
        const EntryMessageHeader header{
            kind, static_cast<std::uint32_t>(length), stored_bytes_read};
        write_all(&header, sizeof(header));
        write_all(content, length);
    }

 private:
    void write_all(const void* content, std::size_t length) const
    {
        for (std::size_t done = 0; done < length;)
        {
            const auto count =
                ::write(pipe_, static_cast<const char*>(content) + done, length - done);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) _exit(0);
            done += static_cast<std::size_t>(count);
        }
    }

    int pipe_;
};

void send_text(const MessagePipe& pipe,
               EntryMessageKind kind,
               std::uint64_t position,
               const std::string& text)
{
    pipe.send(kind, position, text.data(), std::min(text.size(), kMaxMessageBytes));
}

void send_failure(const MessagePipe& pipe, std::uint64_t position, const std::string& reason)
{
    send_text(pipe, EntryMessageKind::failure, position, reason);
}

/** A serialized CRawlog of a version that EntryWalk cannot step into. */
struct UnknownRawlog : std::runtime_error
{
    explicit UnknownRawlog(int version)
        : std::runtime_error("mrpt::obs::CRawlog of version " + std::to_string(version))
    {
    }
};

std::string too_large(std::size_t max_entry_bytes)
{
    return "an entry takes more than " + std::to_string(max_entry_bytes >> 20U) +
           " MB, [input] max_entry_megabytes";
}

/** Passes on what MRPT reads. Where nothing more can be read it says why and ends the process: MRPT
 *  would take a tenth of a second and more to add its call stack to each exception.
 *  Not thread-safe: one caller at a time. */
class EntryArchive : public mrpt::serialization::CArchive
{
 public:
    EntryArchive(const std::string& path, std::size_t max_entry_bytes, const MessagePipe& pipe)
        : source_(path), max_entry_bytes_(max_entry_bytes), pipe_(pipe)
    {
    }

    const GzReader& source() const { return source_; }

    bool at_end()
    {
        try
        {
            return source_.at_end();
        }
        catch (const std::exception&)
        {
            fail(source_.failure());
        }
    }

    /** Whether a serialized CRawlog begins here: then its header has been read, and nothing else.
     *  */
    bool step_into_rawlog(bool& has_end_mark)
    {
        begin_entry();
        std::string name;
        std::int8_t version = 0;
        bool is_old_format = false;
        internal_ReadObjectHeader(name, is_old_format, version);
        served_ = 0;
        if (mrpt::rtti::findRegisteredClass(name) != CLASS_ID(mrpt::obs::CRawlog)) return false;
        if (version != 0 && version != 1) throw UnknownRawlog(version);
        has_end_mark = !is_old_format;
        begin_entry();
        return true;
    }

    /** Reads the object that step_into_rawlog() found instead. */
    void read_object() { ReadObject(); }

    /** Sends what belongs to the entry that was read. */
    void send_entry()
    {
        flush();
        pipe_.send(EntryMessageKind::entry, source_.stored_bytes_read());
    }

    /** Passes over the entry that was read. */
    void begin_entry()
    {
        buffer_.clear();
        served_ = 0;
        bytes_of_entry_ = 0;
        stack_ = static_cast<const char*>(__builtin_frame_address(0));
    }

 private:
    std::size_t read(void* target, std::size_t count) override
    {
        check_stack();
        auto* to = static_cast<char*>(target);
        const auto again = std::min(count, buffer_.size() - served_);
        std::memcpy(to, buffer_.data() + served_, again);
        served_ += again;
        read_anew(to + again, count - again);
        return count;
    }

    void read_anew(char* target, std::size_t count)
    {
        if (count > max_entry_bytes_ - bytes_of_entry_) fail(too_large(max_entry_bytes_));
        bytes_of_entry_ += count;
        while (count > 0)
        {
            if (buffer_.size() == kMaxMessageBytes) flush();
            const auto part = std::min(count, kMaxMessageBytes - buffer_.size());
            read_source(target, part);
            buffer_.append(target, part);
            served_ = buffer_.size();
            target += part;
            count -= part;
        }
    }

    void flush()
    {
        if (!buffer_.empty())
            pipe_.send(EntryMessageKind::bytes,
                       source_.stored_bytes_read(),
                       buffer_.data(),
                       buffer_.size());
        buffer_.clear();
        served_ = 0;
    }

    /** An object may hold objects; MRPT calls itself for each level. */
    void check_stack() const
    {
        const auto* here = static_cast<const char*>(__builtin_frame_address(0));
        if (static_cast<std::size_t>(stack_ - here) > kMaxStackBytes)
            fail("objects within objects, too many levels of them");
    }

    void read_source(char* target, std::size_t count)
    {
        try
        {
            source_.ReadBuffer(target, count);
        }
        catch (const std::exception&)
        {
            fail(source_.failure());
        }
    }

    [[noreturn]] void fail(const std::string& reason) const
    {
        send_failure(pipe_, source_.stored_bytes_read(), reason);
        _exit(0);
    }

    std::size_t write(const void*, std::size_t) override
    {
        throw std::logic_error("EntryArchive does not write");
    }

    GzReader source_;
    std::size_t max_entry_bytes_;
    const MessagePipe& pipe_;
    std::string buffer_;  ///< of the entry, not yet sent
    std::size_t served_ = 0;  ///< how much of buffer_ MRPT has got; the rest it reads again
    std::size_t bytes_of_entry_ = 0;
    const char* stack_ = nullptr;
};

/** A serialized CRawlog of which the reader is inside. */
struct OpenRawlog
{
    std::uint32_t entries_left = 0;
    bool has_end_mark = true;
};

/** Gives the entries of a file in order. Not thread-safe: one caller at a time. */
class EntryWalk
{
 public:
    explicit EntryWalk(EntryArchive& archive) : archive_(archive) {}

    /** Reads one entry and sends it; false at the clean end. */
    bool send_next()
    {
        while (!archive_.at_end() || !open_.empty())
        {
            if (!open_.empty() && open_.back().entries_left == 0)
            {
                close_rawlog();
                continue;
            }
            if (!open_.empty()) --open_.back().entries_left;
            OpenRawlog opened;
            if (!archive_.step_into_rawlog(opened.has_end_mark))
            {
                archive_.read_object();
                archive_.send_entry();
                return true;
            }
            opened.entries_left = archive_.ReadAs<std::uint32_t>();
            open_.push_back(opened);
        }
        return false;
    }

 private:
    void close_rawlog()
    {
        bool unused = false;
        if (archive_.step_into_rawlog(unused))
            throw std::runtime_error("a CRawlog where its comment should be");
        archive_.read_object();
        constexpr std::uint8_t kEndMark = 0x88;
        if (open_.back().has_end_mark && archive_.ReadAs<std::uint8_t>() != kEndMark)
            throw std::runtime_error("a CRawlog does not end where it should");
        archive_.begin_entry();
        open_.pop_back();
    }

    EntryArchive& archive_;
    std::vector<OpenRawlog> open_;
};

void send_until_bad(EntryArchive& archive, const MessagePipe& pipe)
{
    EntryWalk walk(archive);
    do limit_computing(kSecondsPerEntry);
    while (walk.send_next());
    pipe.send(EntryMessageKind::end, archive.source().stored_bytes_read());
}

}  // namespace

void send_entries(const std::string& rawlog, std::size_t max_entry_bytes, int pipe)
{
    const MessagePipe messages(pipe);
    EntryArchive archive(rawlog, max_entry_bytes, messages);
    const auto position = [&] { return archive.source().stored_bytes_read(); };
    const bool system_limits = system_grants_less(kForReading + max_entry_bytes);
    limit_memory(kForReading + max_entry_bytes);
    try
    {
        send_until_bad(archive, messages);
    }
    catch (const std::bad_alloc&)
    {
        send_failure(
            messages, position(), system_limits ? kTooLittleMemory : too_large(max_entry_bytes));
    }
    catch (const UnknownRawlog& error)
    {
        send_text(messages, EntryMessageKind::unknown_object, position(), error.what());
    }
    // MRPT asserts with logic_error.
    catch (const std::exception& error)
    {
        if (const auto object = unknown_object(error))
            send_text(messages, EntryMessageKind::unknown_object, position(), *object);
        else
            send_failure(messages, position(), mrpt_reason(error));
    }
}

}  // namespace fild
