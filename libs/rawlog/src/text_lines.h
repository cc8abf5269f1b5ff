// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace fild
{
/** A line that says something, without the blanks around it. */
struct TextLine
{
    std::string text;
    std::string origin;  ///< "list.txt line 12": named in errors
};

/** `text` without the blanks at its ends. */
std::string trim(const std::string& text);

/** The lines of a text file that are neither blank nor a comment (`#` in front).
 *  \throw std::runtime_error naming the path: a folder, unreadable, or no text. */
std::vector<TextLine> read_text_lines(const std::string& path);

}  // namespace fild
