// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"
#include "fild/detector/loop_detector.h"
#include "fild/rawlog/input_options.h"
#include "fild/render/render_options.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** What is kept of a loop closure until its picture is drawn. */
struct LoopPicture
{
    FrameVerdict verdict;
    double candidate_timestamp = 0;  ///< seconds since the UNIX epoch
    std::vector<PixelPair> inliers;
};

LoopPicture to_loop_picture(const DetectorOutcome& outcome, double candidate_timestamp);

/** Draws the pictures that the options choose, as QUERY_CANDIDATE.png, into a folder that appears
 * when it is complete and replaces an older one of that name. The images come from a second pass
 * over the rawlog, up to the last one needed; an interruption ends it early. \return how many were
 * drawn. \throw std::runtime_error when a picture cannot be written, or as RawlogReader. */
std::size_t draw_match_pictures(const std::vector<LoopPicture>& loops,
                                const TRenderOptions& options,
                                const TInputOptions& input,
                                const std::string& rawlog,
                                const std::string& folder);

}  // namespace fild
