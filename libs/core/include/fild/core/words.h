// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** "1 entry", "2 entries" */
inline std::string count_of(std::size_t count, const std::string& one, const std::string& many)
{
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

/** "1 frame", "2 frames" */
inline std::string count_of(std::size_t count, const std::string& thing)
{
    return count_of(count, thing, thing + "s");
}

/** "a, b" with ", " between the words. */
inline std::string joined(const std::vector<std::string>& words, const std::string& between)
{
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

}  // namespace fild
