// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/stage_times.h"
#include "fild/results/run_summary.h"

#include <functional>
#include <string>

namespace fild
{
/** A step by which a run makes its results. */
struct RunStep
{
    const char* what_fails = nullptr;  ///< in the words of a user: "no map"
    const char* stage = nullptr;  ///< that its time counts for; nullptr: none
};

/** Runs steps. An error ends only the step in which it occurs: the first becomes the reason why the
 *  run is not whole, further ones become notes. Refers to the summary. */
class RunSteps
{
 public:
    /** \param times  so far. */
    RunSteps(RunSummary& summary, StageTimes times);

    /** \return false when the step threw. */
    bool attempt(const RunStep& step, const std::function<void()>& body);

    StageTimes& times() { return times_; }

 private:
    void run(const RunStep& step, const std::function<void()>& body);

    RunSummary& summary_;
    StageTimes times_;
};

}  // namespace fild
