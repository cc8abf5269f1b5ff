// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/evaluation/frame_poses.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace fild
{
/** A row for each loop closure of the page: `query`, `candidate`, `inliers` and, as far as
 *  loops.csv and the trajectories tell, `edge` (used, or why not), `weight`, `translation_sd_m`;
 *  how far the edge is from the trajectory, `residual_before_m`, `residual_before_deg`,
 *  `residual_after_m`, `residual_after_deg`; and how far its position is from the true one of the
 *  query, seen from the candidate, `truth_error_m`, which no error of the trajectory changes.
 *  \param trajectories  `input`, `optimized` and, where its orientations are known, `truth`: all of
 *         them the poses of one body.
 *  \param page  which of `frames` are in the page.
 *  \throw std::runtime_error naming the file, when it is not of these frames. */
nlohmann::ordered_json loops_json(const std::vector<FrameVerdict>& frames,
                                  const std::string& loops_csv,
                                  const std::map<std::string, PosesOfFrames>& trajectories,
                                  const std::vector<bool>& page);

}  // namespace fild
