// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <optional>
#include <string>

namespace fild
{
/** What an exception that came through MRPT's serialization says, in one line: without the banner,
 *  source location and call stack that MRPT puts around it, around our own exceptions too. Bytes
 *  that are not printable ASCII, as the names in damaged files have, become question marks. */
std::string mrpt_reason(const std::exception& error);

/** The object that MRPT could not read because it does not know its class, or that version of it:
 *  "mrpt::obs::CObservationOdometry of version 7". None when the exception has another reason. */
std::optional<std::string> unknown_object(const std::exception& error);

/** Why an entry cannot be read where memory is short. */
constexpr const char* kTooLittleMemory =
    "an entry takes more memory than the system grants (ulimit -v)";

}  // namespace fild
