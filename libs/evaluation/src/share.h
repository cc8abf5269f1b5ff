// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace fild
{
/** part / whole, or nothing when there is no whole. */
inline std::optional<double> share(std::size_t part, std::size_t whole)
{
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace fild
