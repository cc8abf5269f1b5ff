// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/job/output_folder.h"
#include "fild/mapping/map_builder.h"
#include "fild/render/map_scene.h"
#include "fild/report/html_report.h"
#include "fild/run/loop_closure_run.h"
#include "fild/stream/loop_closure_stream.h"
#include "match_pictures.h"
#include "run_record.h"
#include "run_steps.h"

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace fild
{
/** Makes the results of a run, once all that can be read is read: the map, its files, pictures,
 *  summary and report. Refers to its arguments. */
class RunOutput
{
 public:
    RunOutput(const RunRequest& request,
              const OutputFolder& folder,
              const LoopClosureStream& stream,
              RunRecord& record);

    /** Writes all but the summary and the report. The verdicts come first: the rest may take long
     *  and need much memory. */
    void write_results(const MapBuilder& builder);

    /** \param start  of the run. */
    void write_summary_and_report(std::chrono::steady_clock::time_point start);

    /** See RunSteps::attempt(). */
    bool attempt(const RunStep& step, const std::function<void()>& body);

    /** What the ground truth says of the run; nothing when there is none, or it cannot be had. */
    const std::optional<ReportTruth>& truth() const { return truth_; }

 private:
    void build_map(const MapBuilder& builder);
    void write_map_files();
    void judge();
    void draw();
    void draw_map(const std::map<FrameId, DrawnCamera>& cameras);
    std::vector<LoopPicture> pairs_to_draw() const;
    void list_wrong_and_missed();
    std::set<FrameId> wrong_frames() const;
    void write_similarities();
    void complete_summary(std::chrono::steady_clock::time_point start);

    const RunRequest& request_;
    const OutputFolder& folder_;
    const LoopClosureStream& stream_;
    RunRecord& record_;
    RunSteps steps_;
    std::optional<Map> map_;
    std::optional<ReportTruth> truth_;
};

}  // namespace fild
