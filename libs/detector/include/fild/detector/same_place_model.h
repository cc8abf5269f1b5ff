// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/core/pair_evidence.h"

#include <cstddef>

namespace fild
{
/** Coefficients of one log-likelihood ratio. */
struct EvidenceWeights
{
    double bias = 0;
    double inliers = 0;  ///< of log(inliers - 6)
    EvidenceValues of_share{};  ///< of log(share / (1 - share)), for each kind of evidence
};

/** Section [same_place]: the probability that a pair of frames shows one place. The coefficients
 *  are fitted by tests/benchmark/fit_same_place.py to labelled runs. Each has a fixed sign, so that
 *  more of one kind of evidence never changes sides. Against look-alikes, shape, close matches and
 *  overlap count as reasons for doubt: the more alike the two views are, the more of a same place
 *  would match. */
struct TSamePlaceOptions : Options
{
    bool enabled = false;  ///< false: min_inliers (tau) alone decides, as in the paper
    double min_probability = 0.95;  ///< of a loop closure
    EvidenceWeights chance;  ///< keys chance_...; same place against chance
    EvidenceWeights look_alike;  ///< keys look_alike_...; same place against a look-alike

 protected:
    void describe(OptionVisitor& visitor) override;
};

/** Weighs the evidence that two frames show the same place against two other explanations: that the
 *  inliers agree by chance, and that two places look alike. One logistic model for each. Value
 *  type. */
class SamePlaceModel
{
 public:
    /** \throw std::invalid_argument on bad options. */
    explicit SamePlaceModel(const TSamePlaceOptions& options);

    /** The log-likelihood ratios are limited to +-12 (chance) and +-10 (look-alike): a fit to a few
     *  thousand pairs supports no larger ones. Shares among a few inliers tell nothing of
     *  look-alikes: that ratio counts from 10 inliers on, and in full from 40. */
    PairOdds odds(std::size_t inliers, const EvidenceValues& evidence) const;

    /** True when the pair alone reaches min_probability, with equal prior odds for all three
     *  explanations. */
    bool convinces(const PairOdds& odds) const { return odds.log_odds() >= min_log_odds_; }

 private:
    EvidenceWeights chance_;
    EvidenceWeights look_alike_;
    double min_log_odds_;
};

}  // namespace fild
