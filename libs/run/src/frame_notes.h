// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/index/index_options.h"
#include "fild/stream/loop_closure_stream.h"
#include "run_record.h"

#include <string>
#include <vector>

namespace fild
{
/** For the user: frames that were passed over or changed, cameras that were not looked at, whose
 *  calibration does not fit or that have no partner, and why no frame could be a candidate. */
std::vector<std::string> notes_on_frames(const RunRecord& record,
                                         const LoopClosureStream& stream,
                                         const TIndexOptions& delay);

/** Why a run cannot find a loop: of several frames it could use one, or none. Empty: it could use
 *  more. */
std::string too_few_usable_frames(const RunSummary& summary, const FrameBuilder& frames);

/** Counts the frames without depths of their own, by reason. Adds notes where no frame has any,
 *  unless the loops told it already, and where depths are there and yet of little use. */
void add_notes_on_depths(RunSummary& summary,
                         const PlaceMap& places,
                         const TRelativePoseOptions& options);

}  // namespace fild
