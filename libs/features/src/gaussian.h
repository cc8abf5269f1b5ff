// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** exp(-d^2 / 2 sigma^2), while compiling; for distances of up to 4 sigma. */
constexpr float gaussian(double distance, double sigma)
{
    const double exponent = distance * distance / (2 * sigma * sigma);
    double term = 1;
    double sum = 1;
    for (int i = 1; i < 60; ++i)
    {
        term *= exponent / i;
        sum += term;
    }
    return static_cast<float>(1 / sum);
}

}  // namespace fild
