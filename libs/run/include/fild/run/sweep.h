// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/sweep_report.h"
#include "fild/run/swept_key.h"
#include "fild/run/truth.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fild
{
/** The detector on one recording, with every combination of values and every seed. */
struct SweepRequest
{
    std::string rawlog;
    std::string config;
    std::vector<std::string> overrides;  ///< of the configuration, "section.key=value"
    std::vector<SweptKey> keys;  ///< none: only the seeds differ
    /** Beside the configuration as it is, each of these alone: "section.key=value" words. Not
     * together with `keys`. */
    std::vector<std::string> changes;
    std::vector<int> seeds;  ///< empty: the configuration's
    std::size_t max_frames = 0;  ///< 0: all
    int jobs = 1;  ///< so many runs at a time; 0: as many as the hardware has threads
    bool quiet = false;
    TruthOptions truth;
};

/** Runs the detector as rawlog-loop-closure does and scores each run, with the same verdicts for
 *  any number of jobs. Global descriptors and keypoints are computed once for all runs whose
 *  [input], [global_descriptor] and [local_features] are the same, and held in memory until these
 *  are done: half a kilobyte a keypoint. After an interruption the report holds the points of which
 *  all runs were done, and says so.
 *  \throw WrongUsage when a swept key or an override is not of the detector.
 *  \throw std::runtime_error as the readers of rawlog, configuration and truth. */
SweepReport sweep(const SweepRequest& request);

}  // namespace fild
