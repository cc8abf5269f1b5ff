// SPDX-License-Identifier: BSD-3-Clause
// Time of the network of default.ini an image, blob in memory to feature maps in memory, on OpenCV
// and on oneDNN. For median and p95 give
//   network_bench --benchmark_repetitions=20 --benchmark_report_aggregates_only=true
#include "benchmark_run.h"
#include "fild/features/model_file.h"
#include "onednn_network.h"
#include "opencv_network.h"

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include <filesystem>
#include <memory>
#include <string>

namespace
{
using fild::Backend;
using fild::Precision;
using fild::TGlobalDescriptorOptions;

TGlobalDescriptorOptions options_of(Backend backend, Precision precision)
{
    TGlobalDescriptorOptions options;
    options.backend = backend;
    options.model_file = fild::find_model_file(options.model_file);
    options.layers = "FeatureExtractor/MobilenetV2/expanded_conv_14/add";
    options.cell_layer = "FeatureExtractor/MobilenetV2/expanded_conv_9/add";
    options.precision = precision;
    return options;
}

/** Why it cannot be measured here; empty: it can. */
std::string obstacle_to(const TGlobalDescriptorOptions& options)
{
    if (!std::filesystem::exists(options.model_file)) return "missing " + options.model_file;
    if (options.precision != Precision::f32 && !fild::processor_has_bf16())
        return "the processor has no bf16";
    return "";
}

std::unique_ptr<fild::Network> read(const TGlobalDescriptorOptions& options)
{
    return options.backend == Backend::opencv ? fild::read_opencv_network(options)
                                              : fild::read_onednn_network(options);
}

cv::Mat blob_of(const TGlobalDescriptorOptions& options)
{
    const int shape[] = {1, 3, options.input_height, options.input_width};
    cv::Mat blob(4, shape, CV_32F);
    cv::randu(blob, -1, 1);
    return blob;
}

/** One image at a time in each of the benchmark's threads; OpenCV takes further threads for it. */
void forward(benchmark::State& state, Backend backend, Precision precision, int opencv_threads)
{
    const auto options = options_of(backend, precision);
    if (const auto obstacle = obstacle_to(options); !obstacle.empty())
    {
        state.SkipWithError(obstacle.c_str());
        return;
    }
    cv::setNumThreads(opencv_threads);
    const auto network = read(options);
    const auto blob = blob_of(options);
    network->forward(blob);  // the warm-up
    for (auto _ : state) benchmark::DoNotOptimize(network->forward(blob));
    state.SetItemsProcessed(state.iterations());
}

/** From the file to the maps of the first image: what a program waits for when it begins. */
void start(benchmark::State& state, Backend backend)
{
    const auto options = options_of(backend, Precision::f32);
    if (const auto obstacle = obstacle_to(options); !obstacle.empty())
    {
        state.SkipWithError(obstacle.c_str());
        return;
    }
    cv::setNumThreads(1);
    const auto blob = blob_of(options);
    for (auto _ : state) benchmark::DoNotOptimize(read(options)->forward(blob));
}

void configure(benchmark::internal::Benchmark* benchmark)
{
    benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
    benchmark->ComputeStatistics("p95", fild::benchmarks::percentile_95);
}

void side_by_side(benchmark::internal::Benchmark* benchmark)
{
    configure(benchmark);
    benchmark->Threads(1)->Threads(2);
}

BENCHMARK_CAPTURE(forward, opencv, Backend::opencv, Precision::f32, 1)->Apply(configure);
BENCHMARK_CAPTURE(forward, opencv_2_threads, Backend::opencv, Precision::f32, 2)->Apply(configure);
BENCHMARK_CAPTURE(forward, onednn_f32, Backend::onednn, Precision::f32, 1)->Apply(side_by_side);
BENCHMARK_CAPTURE(forward, onednn_mixed, Backend::onednn, Precision::mixed, 1)->Apply(side_by_side);
BENCHMARK_CAPTURE(forward, onednn_bf16, Backend::onednn, Precision::bf16, 1)->Apply(side_by_side);
BENCHMARK_CAPTURE(start, opencv, Backend::opencv)->Apply(configure);
BENCHMARK_CAPTURE(start, onednn, Backend::onednn)->Apply(configure);

}  // namespace

int main(int argc, char** argv)
{
    const auto options = options_of(Backend::onednn, Precision::f32);
    return fild::benchmarks::run(argc, argv, "global_descriptor", options);
}
