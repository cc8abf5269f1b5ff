// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/ground_truth.h"
#include "fild/evaluation/protocol.h"

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
};

/** Files that load_ground_truth() knows, and rawlogs with robot poses or GPS.
 *  \throw std::runtime_error, std::invalid_argument as load_ground_truth(). */
GroundTruth load_truth(const TruthOptions& options, const std::vector<FrameVerdict>& frames);

/** True poses in a file that load_true_poses() knows or a rawlog.
 *  \param sensor  of a rawlog; empty: its only one. */
TruePoses load_poses(const std::string& file,
                     const std::string& sensor,
                     const std::vector<FrameVerdict>& frames);

bool is_rawlog(const std::string& file);

}  // namespace fild
