// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/ground_truth.h"
#include "fild/evaluation/protocol.h"

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Where the ground truth of a recording is, and what it is taken for. */
struct TruthOptions
{
    std::string file;
    std::string sensor;  ///< of a rawlog; empty: its only one
    Protocol protocol;
    std::string trajectory;  ///< file of true poses beside labels; empty: none
    bool min_age_is_given = false;  ///< by the user; else it is the delay of the run
};

/** The protocol for a ground-truth file, of which only the first lines are read.
 *  \param word  what the user asks for; empty: `radius:5` for poses, `exact` for labels.
 *  \throw std::invalid_argument when the word is not a protocol, or not one for such a file.
 *  \throw std::runtime_error as holds_poses(). */
Protocol protocol_for(const std::string& file, const std::string& word);

/** The options for a run with this delay: a younger candidate is one that it never looks at, so it
 *  is not missed, unless the user gives another least age.
 *  \param delay_seconds  of the run; nothing when it is not known. */
TruthOptions for_run(TruthOptions options, std::optional<double> delay_seconds);

/** Files that load_ground_truth() knows, and rawlogs with robot poses or GPS.
 *  \throw std::runtime_error, std::invalid_argument as load_ground_truth(). */
GroundTruth load_truth(const TruthOptions& options, const std::vector<FrameVerdict>& frames);

/** True poses in a file that load_true_poses() knows or a rawlog.
 *  \param sensor  of a rawlog; empty: its only one. */
TruePoses load_poses(const std::string& file,
                     const std::string& sensor,
                     const std::vector<FrameVerdict>& frames);

/** True poses that trajectories can be compared with: those of `options.trajectory`, else of the
 *  ground truth itself, else none. \param truth  of `options.file`; its poses are moved out. */
std::optional<TruePoses> true_poses_for(const TruthOptions& options,
                                        GroundTruth& truth,
                                        const std::vector<FrameVerdict>& frames);

bool is_rawlog(const std::string& file);

}  // namespace fild
