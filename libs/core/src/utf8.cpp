// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/utf8.h"

#include <cstddef>

namespace fild
{
namespace
{
/** Length of the character that begins with a byte; 0: none does. */
std::size_t length_of(unsigned char first)
{
    if (first < 0x80U) return 1;
    if (first < 0xC2U) return 0;  // inside a character, or longer than need be
    if (first < 0xE0U) return 2;
    if (first < 0xF0U) return 3;
    return first < 0xF5U ? 4 : 0;
}

/** What the second byte of a character may be, where that is less than 0x80 to 0xBF: no overlong
 *  forms, no surrogates, nothing above U+10FFFF. */
bool is_second(unsigned char first, unsigned char second)
{
    if (first == 0xE0U) return second >= 0xA0U;
    if (first == 0xEDU) return second <= 0x9FU;
    if (first == 0xF0U) return second >= 0x90U;
    if (first == 0xF4U) return second <= 0x8FU;
    return true;
}

bool is_utf8(const std::string& text)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    for (std::size_t at = 0; at < text.size();)
    {
        const auto length = length_of(byte(at));
        if (length == 0 || at + length > text.size()) return false;
        if (length > 1 && !is_second(byte(at), byte(at + 1))) return false;
        for (std::size_t i = 1; i < length; ++i)
            if ((byte(at + i) & 0xC0U) != 0x80U) return false;
        at += length;
    }
    return true;
}
}  // namespace

std::string as_utf8(const std::string& text)
{
    if (is_utf8(text)) return text;
    std::string converted;
    for (const char c : text)
    {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80U)
        {
            converted += c;
            continue;
        }
        converted += static_cast<char>(0xC0U | (byte >> 6U));
        converted += static_cast<char>(0x80U | (byte & 0x3FU));
    }
    return converted;
}

}  // namespace fild
