// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/core/verdict.h"
#include "fild/core/whole_file.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** Writes what each frame cost as rows of a CSV file that appears when it is whole:
 *
 *  `frame,image_decoding_ms,global_descriptor_ms,local_features_ms,hashing_ms,depth_ms,`
 *  `index_insertion_ms,index_search_ms,matching_ms,verification_ms,relative_pose_ms,whole_frame_ms,`
 *  `map_bytes,resident_bytes`
 *
 *  Milliseconds of wall time, 3 decimals, 0 for a stage that the frame did not reach; stages that
 *  run side by side count in full, so that their sum can be more than whole_frame_ms. Not
 *  thread-safe: one caller at a time. */
class CostCsv
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    explicit CostCsv(const std::string& path);

    /** resident_bytes is empty where the system does not tell.
     *  \param times  of the run so far: the row has what came since the call before.
     *  \param map_bytes  held for later frames. */
    void add(FrameId frame, const StageTimes& times, std::size_t map_bytes);

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    WholeFile file_;
    std::vector<double> totals_ms_;  ///< of the stages, up to the row before
};

}  // namespace fild
