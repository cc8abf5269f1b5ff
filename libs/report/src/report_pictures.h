// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/report/report_options.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace fild
{
/** Frames whose pair has a match picture in the folder, at most options.max_pictures, or half of
 *  that when they have pictures in 3D as well: wrong loop closures first, then rejected pairs, then
 *  the other loop closures spread from the weakest to the strongest.
 *  \param wrong  frames whose loop closure is wrong. */
std::vector<const FrameVerdict*> frames_to_show(const std::string& folder,
                                                const std::vector<FrameVerdict>& frames,
                                                const TReportOptions& options,
                                                const std::set<FrameId>& wrong = {});

/** Puts `pictures` into the page: of these frames those with a match picture, `QUERY_CANDIDATE` to
 * an URL that holds it. And `pictures_3d`: of pairs that have one, evenly over `frames`, so that
 * there are at most `limit` pictures in all. \throw std::runtime_error naming a picture that cannot
 * be read. */
void add_pictures(nlohmann::ordered_json& page,
                  const std::string& folder,
                  const std::vector<const FrameVerdict*>& frames,
                  std::size_t limit,
                  int max_width_px);

/** The pictures of the map that are there, by what they show. */
nlohmann::ordered_json map_pictures_json(const std::string& folder);

}  // namespace fild
