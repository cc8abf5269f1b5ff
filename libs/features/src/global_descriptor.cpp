// SPDX-License-Identifier: BSD-3-Clause
// Global descriptors of FILD (An et al., IROS 2019), section III-A: MobileNetV2 (Sandler et al.,
// CVPR 2018).
#include "fild/features/global_descriptor.h"

#include "fild/features/model_file.h"
#include "network.h"
#include "onednn_network.h"
#include "opencv_network.h"
#include "pooling.h"

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace fild
{
namespace
{
void require_files(const TGlobalDescriptorOptions& options)
{
    const auto is_file = [](const std::string& path)
    { return std::filesystem::is_regular_file(path); };
    if (!is_file(options.model_file))
        throw std::runtime_error(
            "the model file " + options.model_file +
            " is not there; datasets-scripts/get-model.sh gets the default one, "
            "[global_descriptor] model_file names another");
    if (!options.caffe_prototxt_file.empty() && !is_file(options.caffe_prototxt_file))
        throw std::runtime_error("the file " + options.caffe_prototxt_file +
                                 " is not there; [global_descriptor] caffe_prototxt_file names it; "
                                 "leave it empty where model_file is an ONNX file");
}

cv::Mat to_bgr(const cv::Mat& image)
{
    if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_8UC3))
        throw std::invalid_argument(
            "GlobalDescriptorExtractor: the image is not 8 bit grey or BGR");
    if (image.channels() == 3) return image;
    cv::Mat bgr;
    cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
    return bgr;
}

/** 1 x 3 x input_height x input_width: (pixel - mean) x scale. */
cv::Mat to_blob(const cv::Mat& bgr, const TGlobalDescriptorOptions& options)
{
    cv::Mat resized;
    const cv::Size size(options.input_width, options.input_height);
    cv::resize(bgr,
               resized,
               size,
               0,
               0,
               bgr.size().area() > size.area() ? cv::INTER_AREA : cv::INTER_LINEAR);
    const auto mean = options.channel_means();
    const bool rgb = options.channel_order == ChannelOrder::rgb;
    return cv::dnn::blobFromImage(
        resized, options.scale, size, cv::Scalar(mean[0], mean[1], mean[2]), rgb);
}

void require_finite(const std::vector<float>& numbers, const TGlobalDescriptorOptions& options)
{
    if (!std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); }))
        throw std::runtime_error(options.model_file + " gives numbers that are not finite");
}

/** The smallest image that tells everything of a network. */
cv::Mat black_input(const TGlobalDescriptorOptions& options)
{
    return cv::Mat::zeros(options.input_height, options.input_width, CV_8UC3);
}

std::unique_ptr<Network> read_network(const TGlobalDescriptorOptions& options)
{
    require_files(options);
    if (options.backend == Backend::opencv) return read_opencv_network(options);
    return read_onednn_network(options);
}
}  // namespace

GlobalDescriptorExtractor::GlobalDescriptorExtractor(const TGlobalDescriptorOptions& options)
    : options_(options)
{
    options_.check();
    options_.model_file = find_model_file(options_.model_file);
    if (!options_.caffe_prototxt_file.empty())
        options_.caffe_prototxt_file = find_model_file(options_.caffe_prototxt_file);
    network_ = read_network(options_);
    dimension_ = forward(black_input(options_)).global.size();
    const auto wanted = static_cast<std::size_t>(options_.dimension);
    if (wanted != 0 && wanted != dimension_)
        throw std::runtime_error("[global_descriptor] " + options_.model_file +
                                 " gives descriptors of " + std::to_string(dimension_) +
                                 " numbers, but dimension=" + std::to_string(wanted));
}

GlobalDescriptorExtractor::~GlobalDescriptorExtractor() = default;
GlobalDescriptorExtractor::GlobalDescriptorExtractor(GlobalDescriptorExtractor&&) noexcept =
    default;
GlobalDescriptorExtractor& GlobalDescriptorExtractor::operator=(
    GlobalDescriptorExtractor&&) noexcept = default;

ImageAppearance GlobalDescriptorExtractor::extract(const cv::Mat& image)
{
    return forward(to_bgr(image));
}

ImageAppearance GlobalDescriptorExtractor::forward(const cv::Mat& bgr)
{
    auto outputs = network_->forward(to_blob(bgr, options_));
    ImageAppearance appearance;
    if (!options_.cell_layer.empty())
    {
        appearance.cells = to_cells(to_feature_map(outputs.back()));
        outputs.pop_back();
    }
    auto& descriptor = appearance.global;
    for (const auto& output : outputs)
    {
        const auto pooled = pool(to_feature_map(output), options_);
        descriptor.insert(descriptor.end(), pooled.begin(), pooled.end());
    }
    normalize(descriptor.begin(), descriptor.end());
    require_finite(descriptor, options_);
    require_finite(appearance.cells.values, options_);
    return appearance;
}

}  // namespace fild
