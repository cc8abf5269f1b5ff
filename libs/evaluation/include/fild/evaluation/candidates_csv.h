// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** For each frame of a run, in order, its answers in the order of the file. */
using AnswersOfFrames = std::vector<std::vector<ConsideredCandidate>>;

/** Reads a run's candidates.csv, whose columns are
 *  `frame,rank,candidate,similarity,checked,matches,inliers,rejection,support`.
 *  \param frames  of the run.
 *  \throw std::runtime_error naming file and line: unreadable, another header, a row that is no
 *         answer, a frame that the run has not, a candidate that is not an earlier frame, ranks of
 *         a frame that do not increase. Of the answers beyond the first ten a run tells only those that
 *         it verified: ranks have gaps. */
AnswersOfFrames read_candidates_csv(const std::string& path, std::size_t frames);

}  // namespace fild
