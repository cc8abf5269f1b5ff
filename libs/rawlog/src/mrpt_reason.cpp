// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_reason.h"

#include <algorithm>

namespace fild
{
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

}  // namespace fild
