// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/job/output_folder.h"
#include "fild/mapping/map_builder.h"
#include "fild/report/similarity_matrix.h"
#include "fild/results/run_summary.h"
#include "fild/run/loop_closure_run.h"
#include "fild/stream/loop_closure_stream.h"
#include "match_pictures.h"
#include "run_journal.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace fild
{
/** What a run knows of its frames. Refers to its folder. */
struct RunRecord
{
    RunRecord(const OutputFolder& folder, const TRunOptions& options);

    /** The verdict on a frame, in their order. */
    void add(const DetectorOutcome& outcome);

    /** Puts frames.csv, candidates.csv, costs.csv and loops.csv under their names: a run that is
     *  killed while the map is made has its verdicts. Loops have no poses yet. */
    void commit();

    /** Writes loops.csv anew, with what the map tells of each loop; frames.csv too, where depths of
     *  frames came from the motion. */
    void add_map(const Map& map);

    RunJournal journal;
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
};

}  // namespace fild
