// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace fild
{
/** The text as one field of a CSV file, in quotes where RFC 4180 wants them. */
std::string csv_field(const std::string& text);

/** Reads one record of a CSV file (RFC 4180): a line, and the lines after it while a quoted field
 *  is open.
 *  \param record  receives it, without its last line end.
 *  \return how many lines it took; 0 at the end of the file. */
std::size_t read_csv_record(std::istream& file, std::string& record);

/** The fields of one record of a CSV file (RFC 4180), at least one. */
std::vector<std::string> split_csv_fields(const std::string& record);

}  // namespace fild
