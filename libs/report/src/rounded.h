// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace fild
{
/** With so many decimals: files for people are shorter so. */
inline double rounded(double value, int decimals)
{
    const double scale = std::pow(10, decimals);
    return std::round(value * scale) / scale;
}

}  // namespace fild
