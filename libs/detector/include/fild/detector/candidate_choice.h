// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/detector/detector_options.h"
#include "fild/detector/place_states.h"

#include <cstddef>
#include <vector>

namespace fild
{
/** A candidate that the belief may accept. Refers to its entry. */
struct BelievableCandidate
{
    const ConsideredCandidate* entry = nullptr;
    std::size_t place = 0;  ///< in PlaceStates
};

/** Log odds of a pair from which on it may be accepted, by itself or with the frames around it. */
double believable_log_odds(const TDetectorOptions& options);

/** True when the first is the better candidate: its log odds are greater, or those of both are at
 *  least `enough` and it has more inliers, which show more of the place and give a better metric
 *  pose. Equals are compared by their matches. */
bool is_better(const ConsideredCandidate& a, const ConsideredCandidate& b, double enough);

/** Which candidate a verdict names: of those within kEvidenceReach of the most probable candidate's
 *  place, the one with most inliers. \pre there is a candidate. */
const ConsideredCandidate& most_probable(const std::vector<BelievableCandidate>& candidates,
                                         const PlaceStates& states);

/** Probability that the camera is at one of the candidates or at one of the five places before or
 *  after it: several laps show one place, but a candidate far from where the camera is believed to
 *  be does not. */
double probability_near(const std::vector<BelievableCandidate>& candidates,
                        const PlaceStates& states);

}  // namespace fild
