// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/mapping/map_builder.h"
#include "fild/report/html_report.h"
#include "fild/stream/loop_closure_stream.h"
#include "gathered.h"
#include "loop_closure_run.h"
#include "output_folder.h"

#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <string>

namespace fild
{
/** Makes the results of a run, once all that can be read is read: the map, its files, pictures,
 *  summary and report. An error ends only the step that it happens in; the first one stands in the
 *  summary as the reason why the run is not whole, and an interruption does likewise. Refers to its
 *  arguments. */
class RunOutput
{
 public:
    RunOutput(const RunRequest& request,
              const OutputFolder& folder,
              const LoopClosureStream& stream,
              Gathered& gathered);

    /** Writes all but the summary and the report. The verdicts come first: the rest may take long
     *  and need much memory. */
    void write_results(const MapBuilder& builder);

    /** \param start  of the run. */
    void write_summary_and_report(std::chrono::steady_clock::time_point start);

    /** Runs a step; its failure becomes the reason why the run is not whole. */
    void attempt(const std::string& what_fails, const std::function<void()>& step);

    /** What the ground truth says of the run; nothing when there is none, or it cannot be had. */
    const std::optional<ReportTruth>& truth() const { return truth_; }

 private:
    void build_map(const MapBuilder& builder);
    void write_map_files();
    void judge();
    void draw_map();
    void list_wrong_and_missed();
    std::set<FrameId> wrong_frames() const;
    void draw_matches();
    void write_similarities();
    void count_depth_defects();
    void note_sparse_depths();
    void complete_summary(std::chrono::steady_clock::time_point start);

    const RunRequest& request_;
    const TRunOptions& options_;
    const OutputFolder& folder_;
    const LoopClosureStream& stream_;
    Gathered& gathered_;
    RunSummary& summary_;
    StageTimes times_;
    std::optional<Map> map_;
    std::optional<ReportTruth> truth_;
};

}  // namespace fild
