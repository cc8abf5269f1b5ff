// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace fild
{
/** Memory of this process that is in RAM now, bytes; nothing when /proc does not tell. */
std::optional<std::size_t> resident_memory_bytes();

/** The most of it so far, bytes. */
std::size_t peak_memory_bytes();

}  // namespace fild
