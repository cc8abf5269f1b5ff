// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace fild
{
/** Reads a rawlog to its end or to its first bad entry, and writes the bytes of each good entry to
 *  a pipe, as EntryMessageHeader says. An entry is good when MRPT makes objects of it within the
 *  limits; a serialized CRawlog is given as the entries within it. To be called in a process of its
 *  own, of which a bad entry may make anything: it limits the memory of the process, and its
 *  computing time for each entry.
 *  \param max_entry_bytes  of an entry, as unpacked bytes and as objects. */
void send_entries(const std::string& rawlog, std::size_t max_entry_bytes, int pipe);

}  // namespace fild
