// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/report/report_options.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** Frames whose pair has a match picture in the folder, at most options.max_pictures, or half of
 *  that when they have pictures in 3D as well: those of rejected pairs first, then the loop
 * closures spread from the weakest to the strongest. */
std::vector<const FrameVerdict*> frames_to_show(const std::string& folder,
                                                const std::vector<FrameVerdict>& frames,
                                                const TReportOptions& options);

/** The match pictures of these frames, `QUERY_CANDIDATE` (and `QUERY_CANDIDATE_3d`) to an URL that
 *  holds the picture; frames without one are left out. \throw std::runtime_error naming a picture
 *  that cannot be read. */
nlohmann::ordered_json pictures_json(const std::string& folder,
                                     const std::vector<const FrameVerdict*>& frames,
                                     int max_width_px);

/** The pictures of the map that are there, by what they show. */
nlohmann::ordered_json map_pictures_json(const std::string& folder);

}  // namespace fild
