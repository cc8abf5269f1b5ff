// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/parse_number.h"

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** A field of a CSV file that knows where it stands, for errors. */
class CsvField
{
 public:
    /** \param origin  "frames.csv line 3". */
    CsvField(std::string text, std::string column, std::string origin);

    const std::string& text() const { return text_; }
    bool empty() const { return text_.empty(); }

    /** \throw std::runtime_error naming file, line and column. */
    template <class Number>
    Number number() const
    {
        const auto value = parse_number<Number>(text_);
        if (!value) fail("'" + text_ + "' is not a number");
        return *value;
    }

    /** The number, or 0 for an empty field. \throw std::runtime_error as number(). */
    template <class Number>
    Number number_or_zero() const
    {
        return empty() ? Number{} : number<Number>();
    }

    /** \throw std::runtime_error naming file, line and column. */
    [[noreturn]] void fail(const std::string& what) const;

 private:
    std::string text_;
    std::string column_;
    std::string origin_;
};

/** Reads a CSV file (RFC 4180) record by record; its first line names the columns. Not thread-safe:
 *  one caller at a time. */
class CsvReader
{
 public:
    /** \throw std::runtime_error when the file cannot be read. */
    explicit CsvReader(std::string path);

    /** Where a column is; nothing when the file has none of that name. */
    std::optional<std::size_t> position_of(const std::string& column) const;

    /** Moves to the next record. \return false at the end of the file.
     *  \throw std::runtime_error naming file and line when it has another number of fields. */
    bool next();

    /** Of the record that next() moved to. */
    CsvField field(std::size_t position) const;

    /** \throw std::runtime_error naming the file and the line of the record. */
    [[noreturn]] void fail(const std::string& what) const;

    const std::string& path() const { return path_; }

 private:
    std::string origin() const;

    std::string path_;
    std::ifstream file_;
    std::vector<std::string> columns_;
    std::vector<std::string> fields_;
    std::size_t line_ = 1;  ///< of the record
    std::size_t next_line_ = 2;
};

}  // namespace fild
