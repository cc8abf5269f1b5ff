// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/job/output_folder.h"
#include "fild/results/candidates_csv.h"
#include "fild/results/costs_csv.h"
#include "fild/results/frames_csv.h"
#include "fild/stream/loop_closure_stream.h"

#include <array>

namespace fild
{
/** The rows of a run that are on disk as soon as they exist. */
class RunJournal
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    explicit RunJournal(const OutputFolder& folder);

    /** What the frame took that the stream was fed last. */
    void add_costs(FrameId frame, const LoopClosureStream& stream);

    void add(const DetectorOutcome& outcome);

    /** Puts frames.csv, candidates.csv and costs.csv under their names.
     *  \throw std::runtime_error when a row could not be written. */
    void commit();

 private:
    CsvWriter<FrameRow> frames_;
    CsvWriter<CandidateRow> candidates_;
    CsvWriter<CostRow> costs_;
    std::array<double, kFrameStages.size()> stage_totals_ms_{};  ///< of the frames before
};

}  // namespace fild
