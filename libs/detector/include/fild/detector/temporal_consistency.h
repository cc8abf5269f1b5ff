// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/detector/detector_options.h"

namespace fild
{
/** Accepts a verified frame only at the end of beta verified frames in a row, FILD (IROS 2019)
 *  section III-C. Not thread-safe: one caller at a time. */
class TemporalConsistency
{
 public:
    explicit TemporalConsistency(const TConsistencyOptions& options);

    /** The current frame was verified against a candidate seen at `candidate_time`, seconds.
     *  \return true when it closes a row of beta. */
    bool add_verified(double candidate_time);

    /** The current frame was not verified: the row is broken. */
    void add_unverified() { row_ = 0; }

 private:
    int consecutive_frames_;
    double max_candidate_step_seconds_;
    int row_ = 0;
    double last_candidate_time_ = 0;
};

}  // namespace fild
