// SPDX-License-Identifier: BSD-3-Clause
// loop-closure-eval: folders of runs and ground truth in; scores, curves and wrong loops out.
#include "app_main.h"
#include "eval_options.h"
#include "evaluate.h"
#include "fild/report/evaluation_report.h"

namespace
{
constexpr std::size_t kMaxWrongLoopsShown = 20;

void run(const fild::EvalOptions& options)
{
    const auto report = fild::evaluate(options);
    if (!options.output.empty()) fild::write_evaluation(report, options.output);
    std::cout << fild::to_text(report, kMaxWrongLoopsShown);
}

}  // namespace

int main(int argc, char** argv)
{
    return fild::app_main("loop-closure-eval", argc, argv, fild::parse_eval_options, run);
}
