// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

namespace fild
{
/** What an exception says, as one line for the user: without MRPT's banner, source location and
 *  call stack, without line breaks, without the middle of a very long text. When memory ran out:
 *  that, and what to do. */
std::string error_line(const std::exception& error);

}  // namespace fild
