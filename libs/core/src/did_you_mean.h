// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace fild
{
/** "did you mean WORD? " for the known word that is like a mistyped one; else empty. */
std::string did_you_mean(const std::string& typed, const std::vector<std::string>& known);

}  // namespace fild
