// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/stage_times.h"
#include "fild/detector/detector_options.h"
#include "fild/geometry/fundamental_verifier.h"
#include "fild/matching/code_matcher.h"

#include <vector>

namespace fild
{
/** Two frames held against each other. Value type. */
struct VerifiedPair
{
    std::vector<Match> matches;  ///< after the ratio test
    Verification verification;  ///< of `matches`

    std::vector<Match> inliers() const;  ///< of `matches`, in their order
};

/** Matches the codes of two frames and verifies the matches by a fundamental matrix, FILD (IROS
 *  2019) sections III-B and III-C. Deterministic. Const members may run concurrently, each with
 *  its own StageTimes. */
class PairVerifier
{
 public:
    /** \throw std::invalid_argument on bad [hashing] or [verification] options. */
    explicit PairVerifier(const TDetectorOptions& options);

    /** \param times receives "matching" and "verification". */
    VerifiedPair verify(const HashedFeatures& query,
                        const HashedFeatures& candidate,
                        StageTimes& times) const;

 private:
    CodeMatcher matcher_;
    FundamentalVerifier verifier_;
};

}  // namespace fild
