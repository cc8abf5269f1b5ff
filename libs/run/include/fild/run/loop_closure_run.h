// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"
#include "fild/graph/graph_options.h"
#include "fild/render/render_options.h"
#include "fild/report/report_options.h"
#include "fild/run/truth.h"
#include "fild/stream/loop_closure_stream.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fild
{
/** All sections of the .ini file. */
struct TRunOptions
{
    TLoopClosureStreamOptions stream;
    TGraphOptions graph;
    TRenderOptions render;
    TReportOptions report;

    std::vector<std::pair<std::string, Options*>> sections();
};

/** One run of the main job. */
struct RunRequest
{
    std::string command;  ///< that was typed
    std::string rawlog;
    std::string output;  ///< folder
    std::size_t max_frames = 0;  ///< 0: all
    bool quiet = false;
    std::optional<TruthOptions> truth;
    TRunOptions options;
};

/** Runs the detector over the rawlog, builds the map, and writes frames.csv, loops.csv,
 *  candidates.csv, costs.csv, the files of the map (write_map_files()), its pictures
 *  (write_map_pictures()), similarity.png, matches/QUERY_CANDIDATE.jpg, summary.json and
 *  report.html into the output folder; each appears when it is whole. Results of a run before stay
 *  until all frames are read.
 *
 *  When the rawlog breaks off, an error stops the run or the user interrupts it, the results of the
 *  frames before are written all the same, summary.json says why it ended, and then the error is
 * thrown. \throw std::runtime_error when the run did not reach the end of the rawlog or could not
 * begin. */
void run_loop_closure(RunRequest request);

}  // namespace fild
