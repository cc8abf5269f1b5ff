// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** An earlier frame that the index answered with, or that was verified beside the answers. */
struct IndexAnswer
{
    /** Place among the answers, from 1, most similar first; none: no answer, but verified in
     *  addition as a neighbour of the best one. */
    std::optional<std::size_t> rank;
    Candidate candidate;
    bool checked = false;  ///< matched and verified; else the next three say nothing
    std::size_t matches = 0;
    std::size_t inliers = 0;
    Rejection rejection = Rejection::none;  ///< none: verified
};

/** For each frame of a run, in order, its answers in the order of the file. */
using AnswersOfFrames = std::vector<std::vector<IndexAnswer>>;

/** Reads a run's candidates.csv, whose columns are
 *  `frame,rank,candidate,similarity,checked,matches,inliers,rejection`.
 *  \param frames  of the run.
 *  \throw std::runtime_error naming file and line: unreadable, another header, a row that is no
 *         answer, a frame that the run has not, a candidate that is not an earlier frame, ranks of
 *         a frame that are not 1, 2, 3... */
AnswersOfFrames read_candidates_csv(const std::string& path, std::size_t frames);

}  // namespace fild
