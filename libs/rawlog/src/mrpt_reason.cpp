// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_reason.h"

#include <algorithm>
#include <cctype>

namespace fild
{
namespace
{
/** What stands between the last `begin` and the quotation mark behind it; none without `begin`. */
std::optional<std::string> quoted_after(const std::string& text, const std::string& begin)
{
    const auto found = text.rfind(begin);
    if (found == std::string::npos) return std::nullopt;
    const auto start = found + begin.size();
    return text.substr(start, text.find('\'', start) - start);
}

bool is_class_name(const std::string& name)
{
    const auto belongs = [](unsigned char c)
    { return std::isalnum(c) != 0 || c == '_' || c == ':' || c == '<' || c == '>'; };
    return !name.empty() && std::all_of(name.begin(), name.end(), belongs);
}
}  // namespace

std::string mrpt_reason(const std::exception& error)
{
    std::string text = error.what();
    for (const std::string mark : {"==== MRPT exception ====", "Message:"})
        if (const auto at = text.find(mark); at != std::string::npos)
            text.erase(0, at + mark.size());
    text.erase(0, text.find_first_not_of(" \t\n"));
    text.erase(std::min(text.size(), text.find('\n')));
    const auto is_unprintable = [](unsigned char c) { return c < 0x20 || c > 0x7E; };
    std::replace_if(text.begin(), text.end(), is_unprintable, '?');
    return text;
}

std::optional<std::string> unknown_object(const std::exception& error)
{
    const std::string text = error.what();
    auto unknown_class = quoted_after(text, "Stored object has class '");
    if (unknown_class && is_class_name(*unknown_class)) return unknown_class;
    const auto version = quoted_after(text, "unknown serialization version number: '");
    const auto object = quoted_after(text, "parsing typed object '");  // the innermost comes last
    if (!version || !object) return std::nullopt;
    return *object + " of version " + *version;
}

}  // namespace fild
