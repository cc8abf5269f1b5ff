// SPDX-License-Identifier: BSD-3-Clause
#include "number_rows.h"

#include "fild/core/parse_number.h"
#include "fild/core/words.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace fild
{
namespace
{
NumberRow parse_row(const std::string& line, const std::string& origin)
{
    NumberRow row{{}, origin};
    std::istringstream words(line);
    for (std::string word; words >> word;)
    {
        const auto number = parse_number<double>(word);
        if (!number)
            throw std::runtime_error(origin + ": '" + word.substr(0, 40) + "' is not a number");
        row.values.push_back(*number);
    }
    return row;
}
}  // namespace

std::vector<NumberRow> read_number_rows(const std::string& path, std::size_t max_rows)
{
    std::ifstream file(path);
    if (!file || std::filesystem::is_directory(path))
        throw std::runtime_error("cannot read '" + path +
                                 "': " + std::generic_category().message(file ? EISDIR : errno));
    std::vector<NumberRow> rows;
    std::size_t number = 0;
    for (std::string line; rows.size() < max_rows && std::getline(file, line);)
    {
        ++number;
        if (line.find('\0') != std::string::npos)
            throw std::runtime_error(path + " is neither a text file nor a MATLAB file");
        const auto begin = line.find_first_not_of(" \t\r");
        if (begin == std::string::npos || line[begin] == '#') continue;
        rows.push_back(parse_row(line, path + " line " + std::to_string(number)));
    }
    return rows;
}

void require_numbers(const NumberRow& row, std::size_t count, const std::string& meaning)
{
    if (row.values.size() != count)
        throw std::runtime_error(row.origin + ": " + count_of(row.values.size(), "number") +
                                 " where " + std::to_string(count) + " are expected: " + meaning);
}

}  // namespace fild
