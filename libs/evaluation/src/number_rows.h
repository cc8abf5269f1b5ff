// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** A line of numbers. */
struct NumberRow
{
    std::vector<double> values;
    std::string origin;  ///< "poses.txt line 12": named in errors
};

/** Reads the lines of a text file that are neither blank nor a comment (`#`) as numbers separated
 * by blanks. \param max_rows  stop after so many. \throw std::runtime_error naming file and line.
 */
std::vector<NumberRow> read_number_rows(const std::string& path,
                                        std::size_t max_rows = static_cast<std::size_t>(-1));

/** \throw std::runtime_error unless the row has `count` numbers; `meaning` says which. */
void require_numbers(const NumberRow& row, std::size_t count, const std::string& meaning);

}  // namespace fild
