// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace fild
{
/** The whole of `word` as a finite number, or nothing: "0.1abc", "" and "nan" are no numbers. */
template <class Number>
std::optional<Number> parse_number(const std::string& word)
{
    Number value{};
    const char* const end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

/** The words of `text`, which are separated by blanks, as finite numbers. \param origin  named in
 *  errors: where the text came from. \throw std::runtime_error naming the first word that is no
 *  number. */
std::vector<double> parse_numbers(const std::string& text, const std::string& origin);

}  // namespace fild
