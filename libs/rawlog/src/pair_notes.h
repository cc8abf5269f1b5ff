// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/rawlog/stereo_pairing.h"
#include "pair_candidates.h"
#include "partner_search.h"

#include <functional>
#include <string>
#include <vector>

namespace fild
{
/** What is known of a pair at the end of a recording. Refers to its parts. */
struct PairedCameras
{
    const StereoLabels& labels;
    const PartnerSearch& partners;
    PairFit fit;
    std::string without_calibration;  ///< label; where the fit is not_calibrated
    bool has_right;  ///< there was an image of the right camera
};

/** Why images of a pair have no partner, or the pair no depth. */
std::vector<StereoPairNote> notes_on_pair(const PairedCameras& pair, double tolerance_seconds);

/** Why two cameras that look like a pair are none.
 *  \param could_be_left  by its label. */
std::vector<StereoPairNote> notes_on_trials(
    const PairCandidates::Trials& trials,
    double tolerance_seconds,
    const std::function<bool(const std::string&)>& could_be_left);

}  // namespace fild
