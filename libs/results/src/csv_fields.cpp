// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/csv_fields.h"

#include <algorithm>
#include <istream>

namespace fild
{
std::string csv_field(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

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

}  // namespace fild
