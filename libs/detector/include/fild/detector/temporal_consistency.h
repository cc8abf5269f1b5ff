// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/detector/detector_options.h"

#include <map>
#include <string>

namespace fild
{
/** Accepts a verified frame only at the end of beta verified frames of its camera in a row, FILD
 *  (IROS 2019) section III-C. Not thread-safe: one caller at a time. */
class TemporalConsistency
{
 public:
    explicit TemporalConsistency(const TConsistencyOptions& options);

    /** The current frame of a camera was verified against a candidate seen at `candidate_time`,
     *  seconds.
     *  \return true when it closes a row of beta. */
    bool add_verified(const std::string& camera, double candidate_time);

    /** The current frame of a camera was not verified: the row is broken. */
    void add_unverified(const std::string& camera) { rows_.erase(camera); }

 private:
    struct Row
    {
        int length = 0;
        double last_candidate_time = 0;
    };

    int consecutive_frames_;
    double max_candidate_step_seconds_;
    std::map<std::string, Row> rows_;  ///< by camera
};

}  // namespace fild
