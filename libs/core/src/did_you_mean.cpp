// SPDX-License-Identifier: BSD-3-Clause
#include "did_you_mean.h"

#include <algorithm>
#include <numeric>

namespace fild
{
namespace
{
/** How many letters are to be put in, left out or replaced (Levenshtein, 1966). */
std::size_t typing_errors(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> errors(b.size() + 1);
    std::iota(errors.begin(), errors.end(), 0U);
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        auto before = errors[0]++;
        for (std::size_t j = 0; j < b.size(); ++j)
        {
            const auto replaced = before + (a[i] == b[j] ? 0 : 1);
            before = errors[j + 1];
            errors[j + 1] = std::min({replaced, before + 1, errors[j] + 1});
        }
    }
    return errors.back();
}
}  // namespace

std::string did_you_mean(const std::string& typed, const std::vector<std::string>& known)
{
    constexpr std::size_t kLongest = 100;  // what is longer is no word
    if (typed.size() > kLongest) return "";
    const std::string* nearest = nullptr;
    auto fewest = typed.size() / 3 + 1;
    for (const auto& word : known)
        if (const auto errors = typing_errors(typed, word); errors < fewest)
        {
            fewest = errors;
            nearest = &word;
        }
    return nearest == nullptr ? "" : "did you mean " + *nearest + "? ";
}

}  // namespace fild
