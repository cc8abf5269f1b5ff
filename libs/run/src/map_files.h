// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/job/output_folder.h"
#include "fild/mapping/map_builder.h"
#include "fild/results/loops_csv.h"
#include "fild/results/run_summary.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** Removes the map of an earlier run into the folder, and its pictures. */
void remove_map_files(const OutputFolder& folder);

/** Writes poses.csv, poses.graph, poses.g2o, trajectory_input.* and trajectory_optimized.* (.tum or
 *  .kitti) and track.kml, as far as the map goes.
 *  \return for the user: what was not written and why.
 *  \throw std::runtime_error when a file cannot be written. */
std::vector<std::string> write_map_files(const Map& map,
                                         std::size_t camera_frames,
                                         const TGraphOptions& options,
                                         const OutputFolder& folder);

/** The map in numbers; `depth_sources`, `depth_defects` and what write_map_files() says are the
 *  caller's to add. */
MapSummary summary_of(const Map& map, std::size_t camera_frames, const TGraphOptions& options);

/** A loop's row of loops.csv. */
LoopRow row_of(const LoopEdge& loop);

}  // namespace fild
