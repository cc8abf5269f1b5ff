// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace fild
{
/** A command line that was typed wrongly. */
class WrongUsage : public std::invalid_argument
{
 public:
    using std::invalid_argument::invalid_argument;
};

}  // namespace fild
