// SPDX-License-Identifier: BSD-3-Clause
#include "text_lines.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace fild
{
namespace
{
std::ifstream open_text(const std::string& path)
{
    if (std::filesystem::is_directory(path))
        throw std::runtime_error(path + " is a folder, not a text file");
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("cannot read '" + path +
                                 "': " + std::generic_category().message(errno));
    return file;
}
}  // namespace

std::string trim(const std::string& text)
{
    const char* const blanks = " \t\r\n";
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

std::vector<TextLine> read_text_lines(const std::string& path)
{
    auto file = open_text(path);
    std::vector<TextLine> lines;
    int number = 0;
    for (std::string line; std::getline(file, line);)
    {
        const std::string byte_order_mark = "\xEF\xBB\xBF";
        if (++number == 1 && line.rfind(byte_order_mark, 0) == 0) line.erase(0, 3);
        const auto text = trim(line);
        if (text.find('\0') != std::string::npos)
            throw std::runtime_error(path + " is not a text file; check the path");
        if (!text.empty() && text[0] != '#')
            lines.push_back({text, path + " line " + std::to_string(number)});
    }
    return lines;
}

}  // namespace fild
