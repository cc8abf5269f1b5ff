// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace fild
{
/** What the process that reads a rawlog says next on its pipe. */
enum class EntryMessageKind : std::uint32_t
{
    bytes,  ///< part of an entry, which may yet prove to be bad
    entry,  ///< the bytes since the entry before are one that MRPT reads
    end,  ///< the file has ended, cleanly
    failure,  ///< the entry is bad: why, as text
    unknown_object  ///< MRPT does not know its class, or version: which, as text
};

/** Stands before each message on the pipe. Value type. */
struct EntryMessageHeader
{
    EntryMessageKind kind = EntryMessageKind::bytes;
    std::uint32_t length = 0;  ///< bytes that follow, at most kMaxMessageBytes
    std::uint64_t stored_bytes_read = 0;
};

constexpr std::size_t kMaxMessageBytes = std::size_t{1} << 16U;

}  // namespace fild
