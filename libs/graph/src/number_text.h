// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/number_text.h"

#include <string>

namespace fild
{
/** Appends a blank (unless the line is empty) and the shortest text that reads back as the number.
 */
inline void append_number(std::string& line, double number)
{
    if (!line.empty()) line += ' ';
    line += shortest_decimal(number);
}

}  // namespace fild
