// SPDX-License-Identifier: BSD-3-Clause
#include "fild/job/error_line.h"

#include <initializer_list>
#include <new>

namespace fild
{
namespace
{
constexpr const char* kOutOfMemory =
    "out of memory: the run needs more than the system, a container or ulimit -v grants; end other "
    "programs, or process a shorter recording or smaller images";

bool is_out_of_memory(const std::exception& error, const std::string& text)
{
    return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
           text.find("std::bad_alloc") != std::string::npos ||
           text.find("Insufficient memory") != std::string::npos;  // OpenCV's
}

/** MRPT puts a banner before the message, and after it lines that say where it was thrown. */
std::string without_mrpt_frame(std::string text)
{
    const std::string banner = "==== MRPT exception ====";
    const auto begin = text.find(banner);
    if (begin == std::string::npos) return text;
    const auto before = text.substr(0, begin);
    text.erase(0, begin + banner.size());
    const std::string label = "Message:";
    if (const auto at = text.find(label); at != std::string::npos) text.erase(0, at + label.size());
    text.erase(0, text.find_first_not_of(" \t\r\n"));
    return before + text.substr(0, text.find('\n'));
}

std::string in_one_line(const std::string& text)
{
    std::string line;
    for (const char c : text)
    {
        const bool is_blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (!is_blank)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

std::string shortened(const std::string& line)
{
    constexpr std::size_t kBegin = 6000;  // a path may have 4096 characters
    constexpr std::size_t kEnd = 1000;
    if (line.size() <= kBegin + kEnd) return line;
    return line.substr(0, kBegin) + " [...] " + line.substr(line.size() - kEnd);
}
}  // namespace

std::string error_line(const std::exception& error)
{
    const std::string text = error.what();
    if (is_out_of_memory(error, text)) return kOutOfMemory;
    return shortened(in_one_line(without_mrpt_frame(text)));
}

}  // namespace fild
