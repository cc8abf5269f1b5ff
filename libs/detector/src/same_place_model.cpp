// SPDX-License-Identifier: BSD-3-Clause
#include "fild/detector/same_place_model.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace fild
{
namespace
{
constexpr double kLargest = 100;
constexpr double kMaxAgainstChance = 12;
constexpr double kMaxAgainstLookAlike = 10;
constexpr double kInliersOfAnyModel = 6;
constexpr double kLeastShare = 0.003;
constexpr double kInliersThatSayNothing = 10;  // of a look-alike
constexpr double kInliersThatSayAll = 40;

/** +1 or -1: what a greater share says against a look-alike. */
int sign_against_look_alike(Evidence kind)
{
    switch (kind)
    {
        case Evidence::shape_share:
        case Evidence::close_share:
        case Evidence::overlap_share:
            return -1;
        default:
            return 1;
    }
}

void describe_weights(OptionVisitor& visitor,
                      const std::string& prefix,
                      EvidenceWeights& weights,
                      int (*sign_of)(Evidence))
{
    visitor.real(prefix + "bias", weights.bias, -kLargest, kLargest);
    visitor.real(prefix + "inliers", weights.inliers, 0, kLargest);
    for (std::size_t k = 0; k < kEvidenceKinds; ++k)
    {
        const auto kind = static_cast<Evidence>(k);
        const bool positive = sign_of(kind) > 0;
        visitor.real(prefix + to_word(kind),
                     weights.of_share[k],
                     positive ? 0 : -kLargest,
                     positive ? kLargest : 0);
    }
}

double log_likelihood_ratio(const EvidenceWeights& weights,
                            std::size_t inliers,
                            const EvidenceValues& evidence)
{
    const double beyond = std::max(1.0, static_cast<double>(inliers) - kInliersOfAnyModel);
    double sum = weights.bias + weights.inliers * std::log(beyond);
    for (std::size_t k = 0; k < kEvidenceKinds; ++k)
    {
        const double share = std::clamp(evidence[k], kLeastShare, 1 - kLeastShare);
        sum += weights.of_share[k] * log_odds_of(share);
    }
    return sum;
}

/** How much the shares among so many inliers tell of look-alikes, from 0 to 1. */
double trust_in_shares(std::size_t inliers)
{
    const double beyond = static_cast<double>(inliers) - kInliersThatSayNothing;
    return std::clamp(beyond / (kInliersThatSayAll - kInliersThatSayNothing), 0.0, 1.0);
}
}  // namespace

void TSamePlaceOptions::describe(OptionVisitor& visitor)
{
    visitor.flag("enabled", enabled);
    visitor.real("min_probability", min_probability, 0.5, 0.999999);
    describe_weights(visitor, "chance_", chance, [](Evidence) { return 1; });
    describe_weights(visitor, "look_alike_", look_alike, sign_against_look_alike);
}

SamePlaceModel::SamePlaceModel(const TSamePlaceOptions& options)
    : chance_(options.chance),
      look_alike_(options.look_alike),
      min_log_odds_(log_odds_of(options.min_probability))
{
    options.check();
}

PairOdds SamePlaceModel::odds(std::size_t inliers, const EvidenceValues& evidence) const
{
    return {
        std::clamp(log_likelihood_ratio(chance_, inliers, evidence),
                   -kMaxAgainstChance,
                   kMaxAgainstChance),
        trust_in_shares(inliers) * std::clamp(log_likelihood_ratio(look_alike_, inliers, evidence),
                                              -kMaxAgainstLookAlike,
                                              kMaxAgainstLookAlike)};
}

}  // namespace fild
