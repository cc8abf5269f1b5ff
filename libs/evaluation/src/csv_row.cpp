// SPDX-License-Identifier: BSD-3-Clause
#include "csv_row.h"

#include "fild/core/words.h"
#include "fild/evaluation/csv_fields.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace fild
{
std::size_t read_csv_record(std::istream& file, std::string& record)
{
    record.clear();
    std::size_t lines = 0;
    bool is_quoted = false;
    for (std::string line; (lines == 0 || is_quoted) && std::getline(file, line); ++lines)
    {
        if (lines > 0) record += '\n';
        record += line;
        if (std::count(line.begin(), line.end(), '"') % 2 != 0) is_quoted = !is_quoted;
    }
    return lines;
}

std::vector<std::string> split_csv_fields(const std::string& record)
{
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < record.size(); ++i)
    {
        const char c = record[i];
        if (c == '"' && quoted && i + 1 < record.size() && record[i + 1] == '"')
            fields.back() += record[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

CsvRow::CsvRow(const std::string& record, std::string origin, std::size_t columns)
    : fields_(split_csv_fields(record)), origin_(std::move(origin))
{
    if (fields_.size() != columns)
        fail(count_of(fields_.size(), "column") + " instead of " + std::to_string(columns));
}

void CsvRow::fail(const std::string& what) const
{
    throw std::runtime_error(origin_ + ": " + what);
}

void for_each_csv_row(const std::string& path,
                      const std::string& header,
                      const std::function<void(const CsvRow&)>& take)
{
    std::ifstream file(path);
    std::string line;
    if (!file || !std::getline(file, line))
        throw std::runtime_error("cannot read '" + path +
                                 "': " + std::generic_category().message(errno == 0 ? EIO : errno));
    if (line != header && line.rfind(header + ",", 0) != 0)
        throw std::runtime_error(path + " does not begin with the header of " +
                                 std::filesystem::path(path).filename().string());
    const auto columns = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    std::size_t number = 2;
    while (const auto lines = read_csv_record(file, line))
    {
        take(CsvRow(line, path + " line " + std::to_string(number), columns));
        number += lines;
    }
}

}  // namespace fild
