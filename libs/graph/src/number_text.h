// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace fild
{
/** Appends a blank (unless the line is empty) and the shortest text that reads back as the number.
 */
inline void append_number(std::string& line, double number)
{
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number);
    if (!line.empty()) line += ' ';
    line.append(text.data(), end.ptr);
}

}  // namespace fild
