// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/results/csv_columns.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** A row of candidates.csv: an earlier frame that was looked at for a query. Value type. */
struct CandidateRow
{
    FrameId frame{};
    ConsideredCandidate considered;
};

/** rank is the position among the answers of the index, from 1; empty for a frame that was verified
 *  but is not among them. checked is 0 or 1; what comes after it is empty when it is 0, rejection
 *  also when the pair was verified. Then a column for each kind of Evidence, and the PairOdds; they
 *  are empty also when [same_place] is off or the pair has too few inliers. */
CsvColumns<CandidateRow> candidates_csv_columns();

/** For each frame of a run, in order, its answers in the order of the file. */
using AnswersOfFrames = std::vector<std::vector<ConsideredCandidate>>;

/** Reads a run's candidates.csv. Of the answers beyond the first ten a run writes only those that
 *  it verified: ranks have gaps.
 *  \param frames  of the run.
 *  \throw std::runtime_error as read_csv(), and for a frame that the run has not, a candidate that
 *  is
 *         not an earlier frame, or ranks of a frame that do not increase. */
AnswersOfFrames read_candidates_csv(const std::string& path, std::size_t frames);

}  // namespace fild
