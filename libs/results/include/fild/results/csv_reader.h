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
class CsvReader;

/** A field of the record that a reader is at; it knows where it stands, for errors. */
class CsvField
{
 public:
    CsvField(const CsvReader& reader, std::size_t position) : reader_(reader), position_(position)
    {
    }

    const std::string& text() const;
    bool empty() const { return text().empty(); }

    /** \throw std::runtime_error naming file, line and column. */
    template <class Number>
    Number number() const
    {
        const auto value = parse_number<Number>(text());
        if (!value) fail("'" + text() + "' is not a number");
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
    const CsvReader& reader_;
    std::size_t position_;
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

    /** Of the record that next() moved to, until the next call of it. */
    CsvField field(std::size_t position) const { return {*this, position}; }

    /** \throw std::runtime_error naming the file and the line of the record. */
    [[noreturn]] void fail(const std::string& what) const;

 private:
    friend class CsvField;

    std::string origin() const;

    std::string path_;
    std::ifstream file_;
    std::vector<std::string> columns_;
    std::vector<std::string> fields_;
    std::size_t line_ = 1;  ///< of the record
    std::size_t next_line_ = 2;
};

}  // namespace fild
