// SPDX-License-Identifier: BSD-3-Clause
// Matching and verification of FILD (An et al., IROS 2019), sections III-B and III-C.
#include "fild/detector/pair_verifier.h"

#include "fild/geometry/pair_evidence.h"
#include "fild/geometry/shape_agreement.h"

#include <cstdint>
#include <numeric>
#include <utility>

namespace fild
{
namespace
{
/** The explanation that the evidence does not rule out. */
Rejection weakness_of(const PairOdds& odds)
{
    return odds.against_chance < odds.against_look_alike ? Rejection::may_be_chance
                                                         : Rejection::may_be_look_alike;
}
}  // namespace

std::vector<Match> VerifiedPair::inliers() const
{
    std::vector<Match> kept;
    kept.reserve(verification.inliers.size());
    for (const auto k : verification.inliers) kept.push_back(matches[k]);
    return kept;
}

PairVerifier::PairVerifier(const TDetectorOptions& options)
    : min_inliers_(static_cast<std::size_t>(options.verification.min_inliers)),
      matcher_(options.hashing),
      verifier_(options.verification, static_cast<std::uint64_t>(options.runtime.seed)),
      one_shape_(options.verification.one_shape)
{
    if (options.same_place.enabled) model_.emplace(options.same_place);
}

VerifiedPair PairVerifier::verify(const HashedFeatures& query,
                                  const HashedFeatures& candidate,
                                  StageTimes& times) const
{
    VerifiedPair pair;
    std::size_t compared = 0;
    {
        const StageTimer timer(times, "matching");
        auto matching = matcher_.match(query, candidate);
        pair.matches = std::move(matching.matches);
        compared = matching.compared;
    }
    {
        const StageTimer timer(times, "verification");
        pair.verification = verify_matches(query, candidate, pair.matches);
    }
    pair.rejection = pair.verification.rejection;
    if (model_)
    {
        const StageTimer timer(times, "evidence");
        weigh_evidence(query, candidate, compared, pair);
    }
    else
        pair.support = static_cast<double>(pair.verification.inliers.size()) /
                       static_cast<double>(min_inliers_);
    return pair;
}

void PairVerifier::weigh_evidence(const HashedFeatures& query,
                                  const HashedFeatures& candidate,
                                  std::size_t compared,
                                  VerifiedPair& pair) const
{
    if (pair.rejection != Rejection::none) return;
    const auto inliers = pair.inliers();
    pair.evidence = measure_evidence({query, candidate, pair.matches, inliers, compared});
    pair.odds = model_->odds(inliers.size(), pair.evidence);
    pair.support = probability_of(pair.odds->log_odds());
    if (!model_->convinces(*pair.odds)) pair.rejection = weakness_of(*pair.odds);
}

Verification PairVerifier::verify_matches(const HashedFeatures& query,
                                          const HashedFeatures& candidate,
                                          const std::vector<Match>& matches) const
{
    constexpr ShapeTolerance kTried = {30, 1};
    std::vector<std::size_t> tried(matches.size());
    std::iota(tried.begin(), tried.end(), std::size_t{0});
    if (one_shape_)
        tried = indices_of_shape(
            dominant_shape(matches, query.shapes, candidate.shapes, ShapeTolerance{}),
            matches,
            query.shapes,
            candidate.shapes,
            kTried);
    MatchedPixels matched;
    for (const auto k : tried)
    {
        matched.query.push_back(query.positions[matches[k].query]);
        matched.candidate.push_back(candidate.positions[matches[k].candidate]);
    }
    auto verification = verifier_.verify(matched);
    for (auto& k : verification.inliers) k = tried[k];
    return verification;
}

}  // namespace fild
