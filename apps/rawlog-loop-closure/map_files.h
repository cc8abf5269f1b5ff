// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/graph_options.h"
#include "fild/mapping/map_builder.h"
#include "fild/rawlog/input_options.h"
#include "fild/results/loops_csv.h"
#include "fild/results/run_summary.h"
#include "output_folder.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** The rawlog that a map was made from. */
struct MappedRawlog
{
    std::string path;
    TInputOptions input;
    std::size_t camera_frames = 0;
};

/** Removes the map of an earlier run into the folder, and its pictures. */
void remove_map_files(const OutputFolder& folder);

/** Writes poses.csv, poses.graph, poses.g2o, trajectory_input.* and trajectory_optimized.* (.tum or
 *  .kitti) and map.simplemap, as far as the map goes. The observations of map.simplemap come from a
 *  second pass over the rawlog, up to the last keyframe.
 *  \return for the user: what was not written and why.
 *  \throw std::runtime_error when a file cannot be written, or as RawlogReader. */
std::vector<std::string> write_map_files(const Map& map,
                                         const MappedRawlog& rawlog,
                                         const TGraphOptions& options,
                                         const OutputFolder& folder);

/** The map in numbers; `depth_sources`, `depth_defects` and what write_map_files() says are the
 *  caller's to add. */
MapSummary summary_of(const Map& map, std::size_t camera_frames, const TGraphOptions& options);

/** A loop's row of loops.csv. */
LoopRow row_of(const LoopEdge& loop);

}  // namespace fild
