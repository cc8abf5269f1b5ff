// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/results/csv_columns.h"

#include <string>
#include <vector>

namespace fild
{
/** A row of frames.csv. Value type. */
struct FrameRow
{
    FrameVerdict verdict;
    std::string depth_source;  ///< a word of fild::DepthSource
};

/** frame and candidate are numbers of camera frames, from 0; candidate and similarity are empty
 *  when there was none; timestamp in seconds since the UNIX epoch, 6 decimals; accepted 0 or 1;
 *  rejection a word of fild::Rejection, empty when accepted; support as in FrameVerdict, 6
 *  decimals. */
CsvColumns<FrameRow> frames_csv_columns();

/** The verdicts of a run's frames.csv, in the order of frames.
 *  \throw std::runtime_error as read_csv(), and when frames are not 0, 1, 2..., a candidate is not
 *  an
 *         earlier frame, or accepted and rejection contradict each other. */
std::vector<FrameVerdict> read_frames_csv(const std::string& path);

}  // namespace fild
