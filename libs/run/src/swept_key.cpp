// SPDX-License-Identifier: BSD-3-Clause
#include "fild/run/swept_key.h"

#include "fild/core/parse_number.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace fild
{
namespace
{
std::vector<std::string> split_at_commas(const std::string& text)
{
    std::vector<std::string> parts;
    std::istringstream rest(text);
    for (std::string part; std::getline(rest, part, ',');) parts.push_back(part);
    if (text.empty() || text.back() == ',') parts.emplace_back();
    return parts;
}

[[noreturn]] void refuse_seeds(const std::string& words)
{
    throw std::invalid_argument("seeds '" + words + "' are not of the form 1-10 or 1,2,7");
}

int parse_seed(const std::string& word, const std::string& words)
{
    const auto seed = parse_number<int>(word);
    if (!seed || *seed < 0) refuse_seeds(words);
    return *seed;
}

void append_seeds(const std::string& part, const std::string& words, std::vector<int>& seeds)
{
    constexpr int kMostSeeds = 10000;
    const auto dash = part.find('-');
    const int first = parse_seed(part.substr(0, dash), words);
    const int last = dash == std::string::npos ? first : parse_seed(part.substr(dash + 1), words);
    if (last < first || last - first >= kMostSeeds) refuse_seeds(words);
    for (int seed = first; seed <= last; ++seed) seeds.push_back(seed);
}
}  // namespace

SweptKey parse_swept_key(const std::string& words)
{
    const auto equals = words.find('=');
    const auto dot = words.find('.');
    SweptKey swept{words.substr(0, equals), {}};
    if (equals != std::string::npos) swept.values = split_at_commas(words.substr(equals + 1));
    const bool has_blank = std::count(swept.values.begin(), swept.values.end(), "") > 0;
    if (swept.values.empty() || has_blank || dot == std::string::npos || dot == 0 ||
        dot + 1 >= equals)
        throw std::invalid_argument("'" + words + "' is not of the form section.key=value,value");
    return swept;
}

std::vector<std::vector<std::string>> combinations_of(const std::vector<SweptKey>& keys)
{
    std::vector<std::vector<std::string>> combinations(1);
    for (const auto& [key, values] : keys)
    {
        std::vector<std::vector<std::string>> longer;
        longer.reserve(combinations.size() * values.size());
        for (const auto& combination : combinations)
            for (const auto& value : values)
            {
                longer.push_back(combination);
                longer.back().push_back(value);
            }
        combinations = std::move(longer);
    }
    return combinations;
}

std::vector<int> parse_seeds(const std::string& words)
{
    std::vector<int> seeds;
    for (const auto& part : split_at_commas(words)) append_seeds(part, words, seeds);
    auto sorted = seeds;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) refuse_seeds(words);
    return seeds;
}

}  // namespace fild
