// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace fild
{
/** The text unchanged when it is valid UTF-8; else each byte taken for a character of Latin-1, as
 *  old programs wrote labels. The result is always valid UTF-8. */
std::string as_utf8(const std::string& text);

}  // namespace fild
