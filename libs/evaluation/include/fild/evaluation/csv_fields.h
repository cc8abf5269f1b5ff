// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace fild
{
/** The fields of one line of a CSV file (RFC 4180, no line end within a field), at least one. */
std::vector<std::string> split_csv_fields(const std::string& line);

}  // namespace fild
