// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

namespace fild
{
/** A sample of the normal distribution with mean 0 and variance 1. Unlike std::normal_distribution,
 *  the same generator gives the same numbers with every standard library. */
double standard_normal(std::mt19937_64& generator);

}  // namespace fild
