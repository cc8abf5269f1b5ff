// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/number_text.h"

#include <array>
#include <charconv>

namespace fild
{
std::string decimal(double number, int decimals)
{
    std::array<char, 400> text{};  // the largest double has 309 digits before the point
    const auto end = std::to_chars(
        text.data(), text.data() + text.size(), number, std::chars_format::fixed, decimals);
    return {text.data(), end.ptr};
}

std::string shortest_decimal(double number)
{
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number);
    return {text.data(), end.ptr};
}

}  // namespace fild
