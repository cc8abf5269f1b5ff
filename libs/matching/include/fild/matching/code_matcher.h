// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/matching/hashing_options.h"

#include <vector>

namespace fild
{
/** Matches of two images. */
struct Matching
{
    std::vector<Match> matches;
    /** How many keypoints could have been matched: of the image with fewer, those that were
     *  compared with any of the other. */
    std::size_t compared = 0;
};

/** Matches the binary codes of two images: for every code of the query the two nearest codes of the
 *  candidate, then the binary ratio test, FILD (IROS 2019) section III-C.
 *
 *  With search = guided, which is not in the paper, a keypoint of the query is compared only with
 *  those of the candidate that stand where the network's cells say that it has moved to, see
 *  cell_motion(). Among few, the right one stands out where in a whole image others look much like
 *  it. Const members may run concurrently. */
class CodeMatcher
{
 public:
    /** Uses search, ratio and mutual_check. */
    explicit CodeMatcher(const THashingOptions& options);

    /** As below; with search = guided no matches where no cells agree, and in the ratio test the
     *  second nearest is at most as far as an unrelated code. */
    Matching match(const HashedFeatures& query, const HashedFeatures& candidate) const;

    /** Matches in order of the query's features; a feature of the query stands in at most one, with
     *  mutual_check (each the other's nearest of all) a feature of the candidate too. A query code
     *  that meets fewer than two candidate codes is not matched: the ratio test has nothing to
     *  compare with. Deterministic: among equal distances the lower index wins. Costs query.size()
     *  x candidate.size() code comparisons.
     *  \throw std::invalid_argument when the codes differ in length or lack the hash tables, and
     *  with search = guided, which needs more than codes. */
    std::vector<Match> match(const BinaryCodes& query, const BinaryCodes& candidate) const;

 private:
    Matching match_by_cells(const HashedFeatures& query, const HashedFeatures& candidate) const;

    CodeSearch search_;
    double ratio_;
    bool mutual_check_;
};

}  // namespace fild
