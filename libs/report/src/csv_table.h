// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** The text as one CSV field, in quotes where RFC 4180 wants them. */
std::string csv_field(const std::string& text);

/** A CSV file of which only some columns are of interest, by the names in its first line. */
class CsvTable
{
 public:
    /** \throw std::runtime_error naming file and line: unreadable, or a row of another length. */
    explicit CsvTable(const std::string& path);

    /** Of more rows only `max_rows`, at even distances: memory does not grow with the file.
     *  \throw std::runtime_error as above, for all rows. */
    CsvTable(const std::string& path, std::size_t max_rows);

    std::size_t rows() const { return rows_.size(); }
    const std::vector<std::string>& columns() const { return columns_; }

    /** Nothing when there is no such column or the field is empty.
     *  \throw std::runtime_error naming file, line and column when it is no number. */
    std::optional<double> number(std::size_t row, const std::string& column) const;

    std::string text(std::size_t row, const std::string& column) const;

 private:
    std::string path_;
    std::vector<std::string> columns_;
    std::map<std::string, std::size_t> positions_;
    std::vector<std::vector<std::string>> rows_;
    std::vector<std::size_t> numbers_;  ///< of the rows in the file, from 0
};

}  // namespace fild
