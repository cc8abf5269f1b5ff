// SPDX-License-Identifier: BSD-3-Clause
// Time of SURF-128 an image, grey image in memory to features in memory, and of its steps. Each
// line runs the portable code and what this processor has beside it in turn; the time of the line
// is that of the fastest, and the counters are medians: milliseconds of each, and how many times as
// fast as the portable code the fastest is ("ratio").
#include "benchmark_run.h"
#include "fild/core/upper_median.h"
#include "fild/features/surf.h"
#include "hessian_maxima.h"
#include "integral_image.h"
#include "surf_kernels.h"
#include "surf_pipeline.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace
{
using fild::HessianLayer;
using fild::SurfKernels;

/** What the steps read. */
struct Input
{
    cv::Mat image;
    int threads;
    fild::IntegralImage integral;
    std::vector<fild::Keypoint> keypoints;  ///< with angles
    std::vector<HessianLayer> layers;  ///< of all octaves

    Input(const cv::Mat& grey, int num_threads) : image(grey), threads(num_threads), integral(grey)
    {
        const auto kernels = fild::surf_kernels().back();
        keypoints = fild::extract_surf(image, {}, threads, kernels).keypoints;
        const fild::TLocalFeatureOptions options;
        for (int octave = 0; octave < options.octaves; ++octave)
            for (int i = 0; i < options.layers_per_octave + 2; ++i)
                layers.emplace_back(integral, fild::mask_of(octave, i), 1 << octave);
    }
};

using Step = std::function<void(Input&, const SurfKernels&)>;

void integral_image(Input& input, const SurfKernels& /*kernels*/)
{
    benchmark::DoNotOptimize(fild::IntegralImage(input.image));
}

void hessian(Input& input, const SurfKernels& kernels)
{
    for (auto& layer : input.layers) kernels.fill(input.integral, layer, 0, layer.rows);
}

void hessian_and_maxima(Input& input, const SurfKernels& kernels)
{
    benchmark::DoNotOptimize(find_hessian_maxima(input.integral, {}, input.threads, kernels));
}

void orientation(Input& input, const SurfKernels& kernels)
{
    for (const auto& keypoint : input.keypoints)
        benchmark::DoNotOptimize(kernels.orient(input.integral, keypoint));
}

void descriptor(Input& input, const SurfKernels& kernels)
{
    for (const auto& keypoint : input.keypoints)
        benchmark::DoNotOptimize(kernels.describe(input.integral, keypoint));
}

void extract(Input& input, const SurfKernels& kernels)
{
    benchmark::DoNotOptimize(extract_surf(input.image, {}, input.threads, kernels));
}

double seconds_of(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compare(benchmark::State& state, const std::string& name, const Step& step)
{
    const std::string path = FILD_TEST_DATA_DIR "/" + name;
    const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (image.empty())
    {
        state.SkipWithError(("missing " + path).c_str());
        return;
    }
    Input input(image, static_cast<int>(state.range(0)));
    const auto all_kernels = fild::surf_kernels();
    std::vector<std::vector<double>> seconds(all_kernels.size());
    for (auto _ : state)
        for (std::size_t k = 0; k < all_kernels.size(); ++k)
        {
            seconds[k].push_back(seconds_of([&] { step(input, all_kernels[k]); }));
            if (k + 1 == all_kernels.size()) state.SetIterationTime(seconds[k].back());
        }
    for (std::size_t k = 0; k < all_kernels.size(); ++k)
        state.counters[all_kernels[k].processor] = 1e3 * fild::upper_median(seconds[k]);
    state.counters["ratio"] =
        fild::upper_median(seconds.front()) / fild::upper_median(seconds.back());
    state.SetLabel(name + " " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                   ", " + std::to_string(input.keypoints.size()) + " keypoints");
}

void configure(benchmark::internal::Benchmark* benchmark)
{
    benchmark->ArgName("threads")->Arg(1)->Unit(benchmark::kMillisecond)->UseManualTime();
    benchmark->ComputeStatistics("p95", fild::benchmarks::percentile_95);
}

void register_image(const std::string& short_name, const std::string& file)
{
    const std::pair<const char*, Step> steps[] = {{"integral_image", integral_image},
                                                  {"hessian", hessian},
                                                  {"hessian_and_maxima", hessian_and_maxima},
                                                  {"orientation", orientation},
                                                  {"descriptor", descriptor}};
    for (const auto& [name, step] : steps)
        configure(
            benchmark::RegisterBenchmark((name + ("/" + short_name)).c_str(), compare, file, step));
    auto* whole =
        benchmark::RegisterBenchmark(("extract/" + short_name).c_str(), compare, file, extract);
    configure(whole);
    whole->Arg(2);
}

}  // namespace

int main(int argc, char** argv)
{
    register_image("malaga", "pairs/malaga6l_a.jpg");
    register_image("new_college", "pairs/newcollege_a.png");
    register_image("kitti03", "kitti03/images/000000.jpg");
    return fild::benchmarks::run(argc, argv, "local_features", fild::TLocalFeatureOptions());
}
