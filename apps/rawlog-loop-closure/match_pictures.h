// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"
#include "fild/detector/loop_detector.h"
#include "fild/rawlog/input_options.h"
#include "fild/render/render_options.h"
#include "fild/report/report_options.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** What is kept of a loop closure, or of a rejected pair, until its picture is drawn. */
struct LoopPicture
{
    FrameVerdict verdict;
    double candidate_timestamp = 0;  ///< seconds since the UNIX epoch
    std::vector<PixelPair> inliers;
};

/** Chooses of which pairs of a run pictures are drawn: loop closures as [render] says, and of the
 *  rejected pairs those with most support. Not thread-safe: one caller at a time. */
class PairsToDraw
{
 public:
    /** With no pictures of loop closures there are none of rejected pairs either. */
    PairsToDraw(TRenderOptions render, const TReportOptions& report);

    /** \param outcome  with a candidate. */
    void add(const DetectorOutcome& outcome, double candidate_timestamp);

    /** In order of their queries. */
    std::vector<LoopPicture> chosen() const;

 private:
    void add_rejected(const DetectorOutcome& outcome, double candidate_timestamp);

    TRenderOptions render_;
    std::size_t max_rejected_;
    std::vector<LoopPicture> closures_;
    std::vector<LoopPicture> rejected_;  ///< most support first
};

/** Draws the pairs, which stand in order of their queries, as QUERY_CANDIDATE.png, into a folder
 * that appears when it is complete and replaces an older one of that name. The images come from a
 * second pass over the rawlog, up to the last one needed; an interruption ends it early. \return
 * how many were drawn. \throw std::runtime_error when a picture cannot be written, or as
 * RawlogReader. */
std::size_t draw_match_pictures(const std::vector<LoopPicture>& pairs,
                                const TInputOptions& input,
                                const std::string& rawlog,
                                const std::string& folder);

}  // namespace fild
