// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/mapping/map_builder.h"
#include "fild/results/run_summary.h"

#include <string>
#include <vector>

namespace fild
{
/** For the user: what of the recording's motion was not used or cannot be right, and loops without
 *  an edge.
 *  \param summary  of the map, but for its notes. */
std::vector<std::string> notes_on_map(const Map& map,
                                      const MapSummary& summary,
                                      const TGraphOptions& options);

}  // namespace fild
