// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/report/html_report.h"
#include "run_folder.h"

#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** Of a longer recording a page holds some 20,000 frames: a browser opens more of them slowly, or
 *  not at all. */
constexpr std::size_t kMostPageFrames = 20000;

/** Which frames of a run a page holds. */
using PageFrames = std::vector<bool>;

/** All frames, or of more than kMostPageFrames those that tell most: wrong loop closures, missed
 *  loops, other loop closures, then the others, each at even distances where there are too many: a
 *  quarter of the page is left for each kind that follows. With these the candidates of the loop
 *  closures, and the first and the last frame. */
PageFrames page_frames(const RunFolder& run, const std::optional<ReportTruth>& truth);

/** Adds frames and their candidates. */
void add_pairs(PageFrames& page, const std::vector<const FrameVerdict*>& frames);

/** What of the run is in the page, as a reader wants to know it; empty when all of it is. */
std::string note_on_frames(const RunFolder& run,
                           const std::optional<ReportTruth>& truth,
                           const PageFrames& page);

}  // namespace fild
