// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/mapping/map_builder.h"
#include "fild/report/similarity_matrix.h"
#include "fild/results/candidates_csv.h"
#include "fild/results/costs_csv.h"
#include "fild/results/loops_csv.h"
#include "fild/results/run_summary.h"
#include "fild/stream/loop_closure_stream.h"
#include "loop_closure_run.h"
#include "match_pictures.h"
#include "output_folder.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Everything a run gathers on its way through the rawlog. Refers to its folder. */
struct Gathered
{
    Gathered(const OutputFolder& folder, const TRunOptions& options);

    /** A camera frame that the stream just took. */
    void add_costs(FrameId frame, const LoopClosureStream& stream);

    /** The verdict on a frame, in their order. */
    void add(const DetectorOutcome& outcome);

    /** Commits frames.csv, loops.csv, candidates.csv and costs.csv: a run that is killed while the
     *  map is made has its verdicts. Loops have no poses yet. */
    void commit_verdicts();

    /** Writes loops.csv anew, with what the map tells of each loop; frames.csv too, where depths of
     *  frames came from the motion. */
    void add_map(const Map& map);

    CsvWriter<FrameRow> frames;
    CsvWriter<CandidateRow> candidates;
    CsvWriter<CostRow> costs;
    std::optional<SimilarityMatrix> similarities;
    RunSummary summary;
    std::vector<FrameVerdict> verdicts;  ///< of every camera frame
    std::vector<DepthSource> depth_sources;  ///< as many
    PairsToDraw pictures;

 private:
    FrameRow row_of_frame(std::size_t frame, const Map* map) const;
    void write_frames(const Map& map) const;
    void write_loops(const Map* map) const;

    const OutputFolder& folder_;
    std::array<double, kFrameStages.size()> stage_totals_ms_{};  ///< of the frames before
};

}  // namespace fild
