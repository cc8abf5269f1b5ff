// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace fild
{
/** A user's text as a message may quote it: of a long one the beginning and its length. */
inline std::string shortened(const std::string& text)
{
    constexpr std::size_t kMost = 200;
    if (text.size() <= kMost) return text;
    return text.substr(0, kMost) + "... (" + std::to_string(text.size()) + " characters)";
}

}  // namespace fild
