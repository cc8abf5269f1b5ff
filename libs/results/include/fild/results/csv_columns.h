// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/whole_file.h"
#include "fild/results/csv_reader.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** A column of a CSV file of rows: what it is called, how it is written and how it is read. Each
 *  file of a run declares its columns once, for its writer and its reader. */
template <class Row>
struct CsvColumn
{
    std::string name;
    std::function<std::string(const Row&)> text;
    std::function<void(const CsvField&, Row&)> parse;
    bool required = true;  ///< false: files without it are read too
};

template <class Row>
using CsvColumns = std::vector<CsvColumn<Row>>;

/** Adds columns that say something of the base of a row. */
template <class Row, class Base>
void append_columns(CsvColumns<Row>& columns, const CsvColumns<Base>& more)
{
    for (const auto& column : more)
        columns.push_back({column.name, column.text, column.parse, column.required});
}

/** Writes rows (RFC 4180, LF line ends) to a file that appears when it is whole. Each row is handed
 *  to the system at once, so that it survives the end of the process. Not thread-safe: one caller
 *  at a time. */
template <class Row>
class CsvWriter
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    CsvWriter(const std::string& path, CsvColumns<Row> columns)
        : file_(path), columns_(std::move(columns))
    {
        write([](const auto& column) { return column.name; });
    }

    void add(const Row& row)
    {
        write([&](const auto& column) { return column.text(row); });
    }

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    template <class Text>
    void write(const Text& text)
    {
        auto& out = file_.stream();
        for (std::size_t i = 0; i < columns_.size(); ++i)
            out << (i == 0 ? "" : ",") << text(columns_[i]);
        out << '\n' << std::flush;
    }

    WholeFile file_;
    CsvColumns<Row> columns_;
};

/** Hands each row of a file to `take`, with the reader for errors. The columns may stand in any
 *  order, and there may be others.
 *  \throw std::runtime_error naming file and line: unreadable, a required column that is missing, a
 *         row of another length, a field that is not what its column holds. */
template <class Row, class Take>
void read_csv(const std::string& path, const CsvColumns<Row>& columns, const Take& take)
{
    CsvReader reader(path);
    std::vector<std::optional<std::size_t>> positions;
    for (const auto& column : columns)
    {
        positions.push_back(reader.position_of(column.name));
        if (column.required && !positions.back())
            throw std::runtime_error(path + " does not begin with the header of " +
                                     std::filesystem::path(path).filename().string() +
                                     ": it has no column " + column.name);
    }
    while (reader.next())
    {
        Row row{};
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (positions[i]) columns[i].parse(reader.field(*positions[i]), row);
        take(std::move(row), reader);
    }
}

}  // namespace fild
