// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_reason.h"

namespace fild
{
std::string mrpt_reason(const std::exception& error)
{
    std::string text = error.what();
    for (const std::string mark : {"==== MRPT exception ====", "Message:"})
        if (const auto at = text.find(mark); at != std::string::npos)
            text.erase(0, at + mark.size());
    text.erase(0, text.find_first_not_of(" \t\n"));
    return text.substr(0, text.find('\n'));
}

}  // namespace fild
