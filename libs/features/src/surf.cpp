// SPDX-License-Identifier: BSD-3-Clause
// The SURF pipeline: integral image -> Hessian maxima -> orientation -> descriptor.
#include "fild/features/surf.h"

#include "fild/core/parallel_for.h"
#include "hessian_maxima.h"
#include "integral_image.h"
#include "surf_kernels.h"
#include "surf_pipeline.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

namespace fild
{
namespace
{
cv::Mat to_grey(const cv::Mat& image)
{
    if (image.empty()) throw std::invalid_argument("SURF: the image is empty");
    if (image.type() == CV_8UC1) return image;
    if (image.type() != CV_8UC3)
        throw std::invalid_argument("SURF: expected an image of 8 bit, 1 or 3 channels, got " +
                                    cv::typeToString(image.type()));
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    return grey;
}

constexpr std::size_t kKeypointsPerTask = 16;
constexpr float kBlock = 64;  // pixels

/** Indices of the keypoints, by place: neighbours read the same part of the integral image. */
std::vector<std::size_t> by_place(const std::vector<Keypoint>& keypoints)
{
    std::vector<std::size_t> order(keypoints.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto place = [&](std::size_t i)
    { return std::make_tuple(std::floor(keypoints[i].y / kBlock), keypoints[i].x, i); };
    std::sort(order.begin(),
              order.end(),
              [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    return order;
}

/** Removes keypoints without a descriptor: next to the border, where no wavelet fits. */
void remove_undescribed(LocalFeatures& features)
{
    const auto is_zero = [](float value) { return value == 0; };
    std::size_t kept = 0;
    for (std::size_t i = 0; i < features.size(); ++i)
    {
        const auto* descriptor = features.descriptor(i);
        if (std::all_of(descriptor, descriptor + LocalFeatures::dimension, is_zero)) continue;
        if (kept != i)
        {
            features.keypoints[kept] = features.keypoints[i];
            std::copy_n(descriptor,
                        LocalFeatures::dimension,
                        features.descriptors.data() + kept * LocalFeatures::dimension);
        }
        ++kept;
    }
    features.keypoints.resize(kept);
    features.descriptors.resize(kept * LocalFeatures::dimension);
}

/** Sets the angle, unless upright, and gives back the descriptor. */
SurfDescriptor describe(const IntegralImage& integral,
                        const SurfKernels& kernels,
                        bool upright,
                        Keypoint& keypoint)
{
    if (!upright) keypoint.angle = kernels.orient(integral, keypoint);
    return kernels.describe(integral, keypoint);
}
}  // namespace

SurfExtractor::SurfExtractor(const TLocalFeatureOptions& options, int num_threads)
    : options_(options), num_threads_(num_threads)
{
    options_.check();
    if (num_threads < 0)
        throw std::invalid_argument("num_threads=" + std::to_string(num_threads) + " is negative");
}

LocalFeatures SurfExtractor::extract(const cv::Mat& image) const
{
    return extract_surf(image, options_, num_threads_, surf_kernels().back());
}

LocalFeatures extract_surf(const cv::Mat& image,
                           const TLocalFeatureOptions& options,
                           int num_threads,
                           const SurfKernels& kernels)
{
    const IntegralImage integral(to_grey(image));
    LocalFeatures features;
    features.image_size = {image.cols, image.rows};
    features.keypoints = find_hessian_maxima(integral, options, num_threads, kernels);
    features.descriptors.resize(features.size() * LocalFeatures::dimension);
    const auto order = by_place(features.keypoints);
    parallel_for(num_threads,
                 (order.size() + kKeypointsPerTask - 1) / kKeypointsPerTask,
                 [&](std::size_t task)
                 {
                     const auto first = task * kKeypointsPerTask;
                     const auto last = std::min(first + kKeypointsPerTask, order.size());
                     for (auto place = first; place < last; ++place)
                     {
                         const auto i = order[place];
                         const auto numbers =
                             describe(integral, kernels, options.upright, features.keypoints[i]);
                         std::copy(numbers.begin(),
                                   numbers.end(),
                                   features.descriptors.data() + i * LocalFeatures::dimension);
                     }
                 });
    remove_undescribed(features);
    return features;
}

}  // namespace fild
