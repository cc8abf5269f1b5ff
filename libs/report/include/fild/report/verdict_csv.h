// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/core/whole_file.h"

#include <string>

namespace fild
{
/** Writes verdicts as rows of a CSV file (RFC 4180, LF line ends) that appears when it is whole:
 *
 *  `frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,rejection`
 *
 *  frame and candidate are 0-based numbers of camera frames, candidate and similarity empty when
 * there was none; timestamp in seconds since the UNIX epoch, 6 decimals; accepted 0 or 1; rejection
 * a word of fild::Rejection, empty when accepted. Not thread-safe: one caller at a time. */
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

}  // namespace fild
