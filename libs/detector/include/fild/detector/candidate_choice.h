// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
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

/** True when the first has the better evidence, or equal evidence and more matches. */
bool came_further(const ConsideredCandidate& a, const ConsideredCandidate& b);

/** Which candidate a verdict names: of those within kEvidenceReach of the most probable candidate's
 *  place, the one that came further than the others. \pre there is a candidate. */
const ConsideredCandidate& most_probable(const std::vector<BelievableCandidate>& candidates,
                                         const PlaceStates& states);

/** Probability that the camera is at a place within `reach` of one of the candidates: several laps
 *  show one place, but a candidate far from where the camera is believed to be does not. */
double probability_near(const std::vector<BelievableCandidate>& candidates,
                        const PlaceStates& states,
                        int reach);

}  // namespace fild
