// SPDX-License-Identifier: BSD-3-Clause
#include "opencv_network.h"

#include "fild/core/trial_process.h"

#include <opencv2/dnn.hpp>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace fild
{
namespace
{
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

cv::dnn::Net read_files(const TGlobalDescriptorOptions& options)
{
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

/** OpenCV's names of the wanted layers: for ONNX it puts a prefix before the name of a node. */
std::vector<std::string> find_layers(const cv::dnn::Net& net,
                                     const TGlobalDescriptorOptions& options)
{
    const auto known = net.getLayerNames();
    std::vector<std::string> found;
    for (const auto& wanted : wanted_layers(options))
    {
        const auto is_wanted = [&](const std::string& name)
        { return name == wanted.name || name == "onnx_node!" + wanted.name; };
        const auto name = std::find_if(known.begin(), known.end(), is_wanted);
        if (name == known.end()) refuse_missing_layer(wanted, known, options);
        found.push_back(*name);
    }
    return found;
}

class OpenCvNetwork : public Network
{
 public:
    explicit OpenCvNetwork(const TGlobalDescriptorOptions& options)
        : options_(options), net_(read_files(options)), layers_(find_layers(net_, options))
    {
    }

    std::vector<cv::Mat> forward(const cv::Mat& blob) override
    {
        std::vector<cv::Mat> outputs;
        try
        {
            net_.setInput(blob);
            net_.forward(outputs, layers_);
        }
        catch (const cv::Exception& error)
        {
            throw std::runtime_error(
                "[global_descriptor] " + options_.model_file + " does not run on an input of " +
                std::to_string(options_.input_width) + "x" + std::to_string(options_.input_height) +
                ": " + reason_of(error));
        }
        return outputs;
    }

 private:
    TGlobalDescriptorOptions options_;
    cv::dnn::Net net_;
    std::vector<std::string> layers_;
};

void refuse_crashing_network(const TGlobalDescriptorOptions& options)
{
    constexpr TrialLimits kLimits{std::size_t{1} << 30U, 60};
    const auto outcome = run_in_trial(
        [&]
        {
            cv::setNumThreads(1);  // the threads of this process are not in its fork
            const int shape[] = {1, 3, options.input_height, options.input_width};
            OpenCvNetwork(options).forward(cv::Mat::zeros(4, shape, CV_32F));
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

std::unique_ptr<Network> read_opencv_network(const TGlobalDescriptorOptions& options)
{
    refuse_crashing_network(options);
    return std::make_unique<OpenCvNetwork>(options);
}

}  // namespace fild
