// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/parse_number.h"

#include "shortened.h"

#include <sstream>
#include <stdexcept>

namespace fild
{
namespace
{
std::runtime_error not_a_number(const std::string& word, const std::string& origin)
{
    return std::runtime_error(origin + ": '" + shortened(word) + "' is not a number");
}
}  // namespace

std::vector<double> parse_numbers(const std::string& text, const std::string& origin)
{
    std::vector<double> numbers;
    std::istringstream words(text);
    for (std::string word; words >> word;)
    {
        const auto number = parse_number<double>(word);
        if (!number) throw not_a_number(word, origin);
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace fild
