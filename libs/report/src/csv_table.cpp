// SPDX-License-Identifier: BSD-3-Clause
#include "csv_table.h"

#include "fild/core/parse_number.h"
#include "fild/core/words.h"
#include "fild/evaluation/csv_fields.h"

#include <fstream>
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

CsvTable::CsvTable(const std::string& path) : path_(path)
{
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path);
    columns_ = split_csv_fields(line);
    for (std::size_t i = 0; i < columns_.size(); ++i) positions_[columns_[i]] = i;
    while (read_csv_record(file, line) > 0)
    {
        rows_.push_back(split_csv_fields(line));
        if (rows_.back().size() != columns_.size())
            throw std::runtime_error(path + " line " + std::to_string(rows_.size() + 1) + ": " +
                                     count_of(rows_.back().size(), "column") + " instead of " +
                                     std::to_string(columns_.size()));
    }
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
        throw std::runtime_error(path_ + " line " + std::to_string(row + 2) + ": '" + field +
                                 "' is not a number as " + column + " holds");
    return value;
}

}  // namespace fild
