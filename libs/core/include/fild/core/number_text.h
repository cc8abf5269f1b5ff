// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace fild
{
/** The number in fixed notation. As with shortest_decimal(), the program's locale does not matter. */
std::string decimal(double number, int decimals);

/** The shortest text that reads back as the number. */
std::string shortest_decimal(double number);

}  // namespace fild
