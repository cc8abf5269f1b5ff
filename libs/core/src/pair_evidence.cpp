// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/pair_evidence.h"

#include <algorithm>
#include <cmath>

namespace fild
{
std::string to_word(Evidence kind)
{
    constexpr std::array<const char*, kEvidenceKinds> kWords = {
        "inlier_share", "shape_share", "match_share", "close_share", "overlap_share"};
    return kWords.at(to_index(kind));
}

double PairOdds::log_odds() const
{
    const double greater = std::max(-against_chance, -against_look_alike);
    const double lesser = std::min(-against_chance, -against_look_alike);
    return -(greater + std::log1p(std::exp(lesser - greater)));
}

double probability_of(double log_odds)
{
    return 1 / (1 + std::exp(-log_odds));
}

double log_odds_of(double probability)
{
    return std::log(probability / (1 - probability));
}

}  // namespace fild
