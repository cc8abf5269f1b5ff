// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace fild
{
/** Keeps a match when the best code is clearly nearer than the second: d1 <= epsilon^2 * d2.
 *  FILD (IROS 2019) Eq. (6). The authors' published code compares with epsilon, not its square.
 *  \param best,second  Hamming distances, bits, 0 <= best <= second.
 *  \param epsilon      in (0, 1]; the paper uses 0.7.
 *  \return false when second == 0: two identical codes are ambiguous. Never throws. */
constexpr bool passes_ratio_test(int best, int second, double epsilon)
{
    return second > 0 && best <= epsilon * epsilon * second;
}

}  // namespace fild
