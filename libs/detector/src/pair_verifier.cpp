// SPDX-License-Identifier: BSD-3-Clause
// Matching and verification of FILD (An et al., IROS 2019), sections III-B and III-C.
#include "fild/detector/pair_verifier.h"

#include <algorithm>
#include <cstdint>

namespace fild
{
std::vector<Match> VerifiedPair::inliers() const
{
    std::vector<Match> kept;
    kept.reserve(verification.inliers.size());
    for (const auto k : verification.inliers) kept.push_back(matches[k]);
    return kept;
}

PairVerifier::PairVerifier(const TDetectorOptions& options)
    : matcher_(options.hashing),
      verifier_(options.verification, static_cast<std::uint64_t>(options.runtime.seed))
{
}

VerifiedPair PairVerifier::verify(const HashedFeatures& query,
                                  const HashedFeatures& candidate,
                                  StageTimes& times) const
{
    VerifiedPair pair;
    {
        const StageTimer timer(times, "matching");
        pair.matches = matcher_.match(query.codes, candidate.codes);
    }
    const StageTimer timer(times, "verification");
    MatchedPixels matched;
    matched.keypoints = std::min(query.positions.size(), candidate.positions.size());
    matched.query.reserve(pair.matches.size());
    matched.candidate.reserve(pair.matches.size());
    for (const auto& match : pair.matches)
    {
        matched.query.push_back(query.positions[match.query]);
        matched.candidate.push_back(candidate.positions[match.candidate]);
    }
    pair.verification = verifier_.verify(matched);
    return pair;
}

}  // namespace fild
