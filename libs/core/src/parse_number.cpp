// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/parse_number.h"

#include <sstream>
#include <stdexcept>

namespace fild
{
std::vector<double> parse_numbers(const std::string& text, const std::string& origin)
{
    std::vector<double> numbers;
    std::istringstream words(text);
    for (std::string word; words >> word;)
    {
        const auto number = parse_number<double>(word);
        if (!number) throw std::runtime_error(origin + ": '" + word + "' is not a number");
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace fild
