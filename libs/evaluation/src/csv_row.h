// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/parse_number.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace fild
{
/** One record of a CSV file (RFC 4180), which knows at which line it begins. */
class CsvRow
{
 public:
    /** \throw std::runtime_error unless the record has so many columns. */
    CsvRow(const std::string& record, std::string origin, std::size_t columns);

    /** \throw std::runtime_error naming file and line. */
    [[noreturn]] void fail(const std::string& what) const;

    const std::string& text(std::size_t column) const { return fields_[column]; }

    template <class Number>
    Number number(std::size_t column) const
    {
        const auto value = parse_number<Number>(fields_[column]);
        if (!value)
            fail("'" + fields_[column] + "' is not a number as column " +
                 std::to_string(column + 1) + " holds");
        return *value;
    }

    /** The number, or 0 for an empty field. */
    template <class Number>
    Number number_or_zero(std::size_t column) const
    {
        return fields_[column].empty() ? Number{} : number<Number>(column);
    }

 private:
    std::vector<std::string> fields_;
    std::string origin_;
};

/** Hands each record after the header to `take`.
 *  \param header  of the columns that are known; the file may have more after them.
 *  \throw std::runtime_error when the file cannot be read, or begins with another header. */
void for_each_csv_row(const std::string& path,
                      const std::string& header,
                      const std::function<void(const CsvRow&)>& take);

}  // namespace fild
