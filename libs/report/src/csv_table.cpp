// SPDX-License-Identifier: BSD-3-Clause
#include "csv_table.h"

#include "fild/core/parse_number.h"
#include "fild/core/spread.h"
#include "fild/core/words.h"
#include "fild/evaluation/csv_fields.h"

#include <fstream>
#include <limits>
#include <stdexcept>

namespace fild
{
std::string csv_field(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

namespace
{
/** Calls `take(number, fields)` for each row below the first line. \return the first line's fields.
 *  \throw std::runtime_error as CsvTable. */
template <class Take>
std::vector<std::string> for_each_row(const std::string& path, Take&& take)
{
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path);
    auto columns = split_csv_fields(line);
    for (std::size_t number = 0; read_csv_record(file, line) > 0; ++number)
    {
        auto fields = split_csv_fields(line);
        if (fields.size() != columns.size())
            throw std::runtime_error(path + " line " + std::to_string(number + 2) + ": " +
                                     count_of(fields.size(), "column") + " instead of " +
                                     std::to_string(columns.size()));
        take(number, std::move(fields));
    }
    return columns;
}

std::size_t count_rows(const std::string& path)
{
    std::size_t count = 0;
    for_each_row(path, [&](std::size_t, const std::vector<std::string>&) { ++count; });
    return count;
}
}  // namespace

CsvTable::CsvTable(const std::string& path)
    : CsvTable(path, std::numeric_limits<std::size_t>::max())
{
}

CsvTable::CsvTable(const std::string& path, std::size_t max_rows) : path_(path)
{
    const auto wanted = spread_indices(max_rows, count_rows(path));
    auto next = wanted.begin();
    columns_ = for_each_row(path,
                            [&](std::size_t number, std::vector<std::string> fields)
                            {
                                if (next == wanted.end() || *next != number) return;
                                ++next;
                                numbers_.push_back(number);
                                rows_.push_back(std::move(fields));
                            });
    for (std::size_t i = 0; i < columns_.size(); ++i) positions_[columns_[i]] = i;
}

std::string CsvTable::text(std::size_t row, const std::string& column) const
{
    const auto position = positions_.find(column);
    return position == positions_.end() ? "" : rows_.at(row)[position->second];
}

std::optional<double> CsvTable::number(std::size_t row, const std::string& column) const
{
    const auto field = text(row, column);
    if (field.empty()) return std::nullopt;
    const auto value = parse_number<double>(field);
    if (!value)
        throw std::runtime_error(path_ + " line " + std::to_string(numbers_.at(row) + 2) + ": '" +
                                 field + "' is not a number as " + column + " holds");
    return value;
}

}  // namespace fild
