// SPDX-License-Identifier: BSD-3-Clause
// The SURF pipeline: integral image -> Hessian maxima -> orientation -> descriptor.
#include "fild/features/surf.h"

#include "fild/core/parallel_for.h"
#include "hessian_maxima.h"
#include "integral_image.h"
#include "orientation.h"
#include "surf_descriptor.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

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

bool is_zero(const SurfDescriptor& descriptor)
{
    return std::all_of(
        descriptor.begin(), descriptor.end(), [](float value) { return value == 0; });
}

/** Leaves out keypoints without a descriptor: next to the border, where no wavelet fits. */
LocalFeatures collect(const std::vector<Keypoint>& keypoints,
                      const std::vector<SurfDescriptor>& descriptors,
                      const cv::Mat& image)
{
    LocalFeatures features;
    features.image_size = {image.cols, image.rows};
    features.keypoints.reserve(keypoints.size());
    features.descriptors.reserve(keypoints.size() * LocalFeatures::dimension);
    for (std::size_t i = 0; i < keypoints.size(); ++i)
    {
        if (is_zero(descriptors[i])) continue;
        features.keypoints.push_back(keypoints[i]);
        features.descriptors.insert(
            features.descriptors.end(), descriptors[i].begin(), descriptors[i].end());
    }
    return features;
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
    const IntegralImage integral(to_grey(image));
    auto keypoints = find_hessian_maxima(integral, options_, num_threads_);
    std::vector<SurfDescriptor> descriptors(keypoints.size());
    parallel_for(num_threads_,
                 keypoints.size(),
                 [&](std::size_t i)
                 {
                     if (!options_.upright)
                         keypoints[i].angle = dominant_orientation(integral, keypoints[i]);
                     descriptors[i] = surf_descriptor(integral, keypoints[i]);
                 });
    return collect(keypoints, descriptors, image);
}

}  // namespace fild
