// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/mapping/map_builder.h"
#include "fild/report/cost_csv.h"
#include "fild/report/run_summary.h"
#include "fild/report/similarity_matrix.h"
#include "fild/report/verdict_csv.h"
#include "fild/stream/loop_closure_stream.h"
#include "loop_closure_run.h"
#include "match_pictures.h"
#include "output_folder.h"

#include <optional>
#include <vector>

namespace fild
{
/** Everything a run gathers on its way through the rawlog. */
struct Gathered
{
    Gathered(const OutputFolder& folder, const TRunOptions& options);

    /** \param stream  that gave the outcome. */
    void add(const DetectorOutcome& outcome, const LoopClosureStream& stream);

    /** Writes what waits for the map: where depths came from, and what became of each loop. */
    void write_rows(const std::optional<Map>& map);

    VerdictCsv frames;
    LoopCsv loops;
    CandidateCsv candidates;
    CostCsv costs;
    std::optional<SimilarityMatrix> similarities;
    RunSummary summary;
    std::vector<FrameVerdict> verdicts;  ///< of every camera frame
    std::vector<DepthSource> depth_sources;  ///< as many
    PairsToDraw pictures;
};

}  // namespace fild
