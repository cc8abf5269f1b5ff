// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace fild
{
/** A key of the configuration and the values it is given in turn. */
struct SweptKey
{
    std::string key;  ///< "section.key"
    std::vector<std::string> values;  ///< at least one
};

/** Reads `section.key=a,b,c`. \throw std::invalid_argument quoting the words. */
SweptKey parse_swept_key(const std::string& words);

/** One value for each key, all combinations; those of the last key follow one another. Without keys
 *  there is one combination, of no values. */
std::vector<std::vector<std::string>> combinations_of(const std::vector<SweptKey>& keys);

/** Reads seeds: numbers and ranges, `1-10` or `1,2,7-9`.
 *  \throw std::invalid_argument quoting the words. */
std::vector<int> parse_seeds(const std::string& words);

}  // namespace fild
