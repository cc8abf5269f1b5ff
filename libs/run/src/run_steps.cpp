// SPDX-License-Identifier: BSD-3-Clause
#include "run_steps.h"

#include "fild/job/error_line.h"
#include "fild/job/interruption.h"

#include <exception>
#include <utility>

namespace fild
{
RunSteps::RunSteps(RunSummary& summary, StageTimes times)
    : summary_(summary), times_(std::move(times))
{
}

bool RunSteps::attempt(const RunStep& step, const std::function<void()>& body)
{
    try
    {
        run(step, body);
        return true;
    }
    catch (const Interrupted& interruption)
    {
        if (summary_.ended_early.empty()) summary_.ended_early = interruption.what();
    }
    catch (const std::exception& error)
    {
        const auto reason = step.what_fails + (": " + error_line(error));
        if (summary_.ended_early.empty())
            summary_.ended_early = reason;
        else
            summary_.map.notes.push_back(reason);
    }
    return false;
}

void RunSteps::run(const RunStep& step, const std::function<void()>& body)
{
    if (step.stage == nullptr) return body();
    const StageTimer timer(times_, step.stage);
    body();
}

}  // namespace fild
