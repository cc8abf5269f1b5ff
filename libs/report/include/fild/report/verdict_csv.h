// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/core/whole_file.h"

#include <string>
#include <vector>

namespace fild
{
/** Writes verdicts as rows of a CSV file (RFC 4180, LF line ends) that appears when it is whole:
 *
 *  `frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,rejection,support`
 *
 *  frame and candidate are 0-based numbers of camera frames, candidate and similarity empty when
 * there was none; timestamp in seconds since the UNIX epoch, 6 decimals; accepted 0 or 1; rejection
 * a word of fild::Rejection, empty when accepted; support as in FrameVerdict, 6 decimals. Not
 * thread-safe: one caller at a time. */
class VerdictCsv
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    explicit VerdictCsv(const std::string& path);

    void add(const FrameVerdict& verdict);

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    WholeFile file_;
};

/** Writes the earlier frames that were looked at for each query as rows of a CSV file that appears
 *  when it is whole:
 *
 *  `frame,rank,candidate,similarity,checked,matches,inliers,rejection,support`
 *
 *  rank is the place among the answers of the index from 1, empty for a frame that was verified but
 *  was none of them; checked 0 or 1; what comes after it is empty when it is 0, and rejection when
 *  the candidate was verified. Not thread-safe: one caller at a time. */
class CandidateCsv
{
 public:
    /** \throw std::runtime_error as WholeFile. */
    explicit CandidateCsv(const std::string& path);

    void add(FrameId frame, const std::vector<ConsideredCandidate>& considered);

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    WholeFile file_;
};

}  // namespace fild
