// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

namespace fild::benchmarks
{
inline double percentile_95(const std::vector<double>& values)
{
    auto sorted = values;
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::min(sorted.size() - 1, sorted.size() * 95 / 100)];
}

/** What main() does: runs all benchmarks, and says what was measured with which options.
 *  \param section  of the options. \return the exit status. */
inline int run(int argc, char** argv, const std::string& section, const Options& options)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("compiler", __VERSION__);
    benchmark::AddCustomContext("build type", FILD_BUILD_TYPE);
    benchmark::AddCustomContext("commit at configure time", FILD_COMMIT);
    for (const auto& [key, value] : options.values())
        benchmark::AddCustomContext(section + "." + key, value);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace fild::benchmarks
