// SPDX-License-Identifier: BSD-3-Clause
// Global descriptors of FILD (An et al., IROS 2019), section III-A: MobileNetV2 (Sandler et al.,
// CVPR 2018).
#include "fild/features/global_descriptor.h"

#include "fild/core/trial_process.h"
#include "fild/features/model_file.h"
#include "pooling.h"

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
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

/** The file or files of the network, for messages. */
std::string files_of(const TGlobalDescriptorOptions& options)
{
    if (options.caffe_prototxt_file.empty()) return options.model_file;
    return options.model_file + " with " + options.caffe_prototxt_file;
}

/** OpenCV's own words, of which the first line says what is wrong.
 *  \throw std::bad_alloc when that is a lack of memory. */
std::string reason_of(const cv::Exception& error)
{
    if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
    return error.err.substr(0, error.err.find('\n'));
}

cv::dnn::Net read_network(const TGlobalDescriptorOptions& options)
{
    require_files(options);
    try
    {
        auto net = options.caffe_prototxt_file.empty()
                       ? cv::dnn::readNetFromONNX(options.model_file)
                       : cv::dnn::readNetFromCaffe(options.caffe_prototxt_file, options.model_file);
        net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
        return net;
    }
    catch (const cv::Exception& error)
    {
        throw std::runtime_error("cannot read " + files_of(options) +
                                 " as a network: " + reason_of(error));
    }
}

std::string last_layers(const std::vector<cv::String>& names)
{
    constexpr std::size_t kShown = 8;
    std::string last;
    for (auto i = names.size() - std::min(names.size(), kShown); i < names.size(); ++i)
        last += " '" + names[i] + "'";
    return last;
}

/** The name under which OpenCV keeps the wanted layer: for ONNX it puts a prefix before the name of a
 *  node. */
std::string find_layer(const cv::dnn::Net& net,
                       const std::string& key,
                       const std::string& wanted,
                       const TGlobalDescriptorOptions& options)
{
    const auto known = net.getLayerNames();
    const auto is_wanted = [&](const std::string& name)
    { return name == wanted || name == "onnx_node!" + wanted; };
    const auto name = std::find_if(known.begin(), known.end(), is_wanted);
    if (name == known.end())
        throw std::runtime_error("[global_descriptor] " + key + ": " + options.model_file +
                                 " has no layer '" + wanted + "'; its last are" +
                                 last_layers(known));
    return *name;
}

/** The layers of the descriptor, then that of the cells. */
std::vector<std::string> find_layers(const cv::dnn::Net& net,
                                     const TGlobalDescriptorOptions& options)
{
    std::vector<std::string> found;
    for (const auto& wanted : options.layer_names())
        found.push_back(find_layer(net, "layers", wanted, options));
    if (!options.cell_layer.empty())
        found.push_back(find_layer(net, "cell_layer", options.cell_layer, options));
    return found;
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
/** The wanted layers' outputs for an image. */
std::vector<cv::Mat> outputs_of(cv::dnn::Net& net,
                                const std::vector<std::string>& layers,
                                const cv::Mat& bgr,
                                const TGlobalDescriptorOptions& options)
{
    std::vector<cv::Mat> outputs;
    try
    {
        net.setInput(to_blob(bgr, options));
        net.forward(outputs, layers);
    }
    catch (const cv::Exception& error)
    {
        throw std::runtime_error("[global_descriptor] " + options.model_file +
                                 " does not run on an input of " +
                                 std::to_string(options.input_width) + "x" +
                                 std::to_string(options.input_height) + ": " + reason_of(error));
    }
    return outputs;
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

/** OpenCV 4.6 crashes on some damaged networks. */
void refuse_crashing_network(const TGlobalDescriptorOptions& options)
{
    constexpr TrialLimits kLimits{std::size_t{1} << 30U, 60};
    const auto outcome = run_in_trial(
        [&]
        {
            cv::setNumThreads(1);  // the threads of this process are not in its fork
            auto net = read_network(options);
            outputs_of(net, find_layers(net, options), black_input(options), options);
            return std::string();
        },
        kLimits);
    if (!outcome.crash.empty())
        throw std::runtime_error("cannot read " + files_of(options) +
                                 " as a network: OpenCV's attempt ended in " + outcome.crash +
                                 "; get the file again");
    if (outcome.error) throw std::runtime_error(*outcome.error);
}
}  // namespace

struct GlobalDescriptorExtractor::Network
{
    cv::dnn::Net net;
    std::vector<std::string> layers;
};

GlobalDescriptorExtractor::GlobalDescriptorExtractor(const TGlobalDescriptorOptions& options)
    : options_(options), network_(std::make_unique<Network>())
{
    options_.check();
    options_.model_file = find_model_file(options_.model_file);
    if (!options_.caffe_prototxt_file.empty())
        options_.caffe_prototxt_file = find_model_file(options_.caffe_prototxt_file);
    refuse_crashing_network(options_);
    network_->net = read_network(options_);
    network_->layers = find_layers(network_->net, options_);
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
    auto outputs = outputs_of(network_->net, network_->layers, bgr, options_);
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
