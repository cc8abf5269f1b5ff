// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/pair_evidence.h"
#include "fild/core/stage_times.h"
#include "fild/core/verdict.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/same_place_model.h"
#include "fild/geometry/fundamental_verifier.h"
#include "fild/matching/code_matcher.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** Two frames held against each other, and nothing else. Value type. */
struct VerifiedPair
{
    std::vector<Match> matches;  ///< after the ratio test
    Verification verification;  ///< of `matches`
    EvidenceValues evidence{};  ///< with `odds`
    std::optional<PairOdds> odds{};  ///< none: [same_place] is off, or the pair is not verified
    double support = 0;  ///< as FrameVerdict::support
    Rejection rejection = Rejection::none;  ///< none: they show one place

    std::vector<Match> inliers() const;  ///< of `matches`, in their order
};

/** Matches the codes of two frames and verifies the matches by a fundamental matrix, FILD (IROS
 *  2019) sections III-B and III-C; with [same_place], weighs the evidence for one place.
 *  Deterministic. Const members may run concurrently, each with
 *  its own StageTimes. */
class PairVerifier
{
 public:
    /** \throw std::invalid_argument on bad [hashing], [verification] or [same_place] options. */
    explicit PairVerifier(const TDetectorOptions& options);

    /** \param times receives "matching", "verification" and, with [same_place], "evidence". */
    VerifiedPair verify(const HashedFeatures& query,
                        const HashedFeatures& candidate,
                        StageTimes& times) const;

    /** tau: fewer inliers are no loop. */
    std::size_t min_inliers() const { return min_inliers_; }

 private:
    Verification verify_matches(const HashedFeatures& query,
                                const HashedFeatures& candidate,
                                const std::vector<Match>& matches) const;
    void weigh_evidence(const HashedFeatures& query,
                        const HashedFeatures& candidate,
                        std::size_t compared,
                        VerifiedPair& pair) const;

    std::size_t min_inliers_;
    CodeMatcher matcher_;
    FundamentalVerifier verifier_;
    bool one_shape_;
    std::optional<SamePlaceModel> model_;  ///< none: [same_place] is off
};

}  // namespace fild
