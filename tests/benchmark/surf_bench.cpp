// SPDX-License-Identifier: BSD-3-Clause
// Time of SURF-128 an image, grey image in memory to features in memory. For median and p95 give
//   surf_bench --benchmark_repetitions=20 --benchmark_report_aggregates_only=true
#include "fild/features/surf.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
double percentile_95(const std::vector<double>& values)
{
    auto sorted = values;
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::min(sorted.size() - 1, sorted.size() * 95 / 100)];
}

void surf_extract(benchmark::State& state, const std::string& name)
{
    const std::string path = FILD_TEST_DATA_DIR "/pairs/" + name;
    const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (image.empty())
    {
        state.SkipWithError(("missing " + path).c_str());
        return;
    }
    const fild::SurfExtractor extractor({}, static_cast<int>(state.range(0)));
    std::size_t keypoints = extractor.extract(image).size();  // also the warm-up
    for (auto _ : state) benchmark::DoNotOptimize(keypoints = extractor.extract(image).size());
    state.counters["keypoints"] = static_cast<double>(keypoints);
    state.SetLabel(name + " " + std::to_string(image.cols) + "x" + std::to_string(image.rows));
}

void configure(benchmark::internal::Benchmark* benchmark)
{
    benchmark->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
    benchmark->ComputeStatistics("p95", percentile_95);
}

BENCHMARK_CAPTURE(surf_extract, malaga, std::string("malaga6l_a.jpg"))->Apply(configure);
BENCHMARK_CAPTURE(surf_extract, new_college, std::string("newcollege_a.png"))->Apply(configure);

}  // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("compiler", __VERSION__);
    benchmark::AddCustomContext("build type", FILD_BUILD_TYPE);
    benchmark::AddCustomContext("commit at configure time", FILD_COMMIT);
    for (const auto& [key, value] : fild::TLocalFeatureOptions().values())
        benchmark::AddCustomContext("local_features." + key, value);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
