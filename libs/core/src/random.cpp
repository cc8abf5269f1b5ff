// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/random.h"

#include <cmath>

namespace fild
{
namespace
{
/** Uniform in (0, 1]: never 0, so that its logarithm is finite. */
double uniform_positive(std::mt19937_64& generator)
{
    return (static_cast<double>(generator() >> 11U) + 1.0) * 0x1.0p-53;
}
}  // namespace

// Box and Muller, 1958; the second sample of the pair is not used, so no state outlives the call.
double standard_normal(std::mt19937_64& generator)
{
    constexpr double kTwoPi = 6.283185307179586;
    const double radius = std::sqrt(-2.0 * std::log(uniform_positive(generator)));
    return radius * std::cos(kTwoPi * uniform_positive(generator));
}

}  // namespace fild
