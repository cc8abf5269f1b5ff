// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-eval: runs, or a recording to repeat runs on, and ground truth in; scores, curves,
// tables and wrong loops out.
#include "app_main.h"
#include "eval_options.h"
#include "fild/evaluation/evaluation_report.h"
#include "fild/evaluation/sweep_report.h"
#include "fild/job/output_folder.h"

#include <optional>

namespace
{
constexpr std::size_t kMaxWrongLoopsShown = 20;

void score_runs(const fild::EvalOptions& options)
{
    const auto report = fild::evaluate(options.evaluation);
    if (!options.output.empty()) fild::write_evaluation(report, options.output);
    std::cout << fild::to_text(report, kMaxWrongLoopsShown);
}

void score_sweep(const fild::EvalOptions& options)
{
    std::optional<fild::OutputFolder> folder;  // a bad one is told before hours of runs
    if (!options.output.empty()) folder.emplace(options.output);
    const auto report = fild::sweep(*options.sweep);
    if (folder && !report.points.empty()) fild::write_sweep(report, options.output);
    std::cout << fild::to_text(report, kMaxWrongLoopsShown);
    if (!report.ended_early.empty()) throw std::runtime_error(report.ended_early);
}

void run(const fild::EvalOptions& options)
{
    if (options.sweep)
        score_sweep(options);
    else
        score_runs(options);
}
}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("loop-closure-eval", argc, argv, fild::parse_eval_options, run);
}
