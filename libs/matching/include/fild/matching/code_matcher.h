// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/matching/hashing_options.h"

#include <vector>

namespace fild
{
/** Matches the binary codes of two images: for every code of the query the two nearest codes of the
 *  candidate, then the binary ratio test, FILD (IROS 2019) section III-C. Const members may run
 *  concurrently. */
class CodeMatcher
{
 public:
    /** Uses search, ratio and mutual_check. */
    explicit CodeMatcher(const THashingOptions& options);

    /** Matches in order of the query's features; a feature of the query stands in at most one, with
     *  mutual_check (each the other's nearest of all) a feature of the candidate too. A query code
     * that meets fewer than two candidate codes is not matched: the ratio test has nothing to
     * compare with. Deterministic: among equal distances the lower index wins. Costs query.size() x
     * candidate.size() code comparisons. \throw std::invalid_argument when the codes differ in
     * length or lack the hash tables. */
    std::vector<Match> match(const BinaryCodes& query, const BinaryCodes& candidate) const;

 private:
    CodeSearch search_;
    double ratio_;
    bool mutual_check_;
};

}  // namespace fild
