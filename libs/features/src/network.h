// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/features/global_descriptor_options.h"

#include <opencv2/core/mat.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace fild
{
/** A convolutional network that was read from a file, ready to run. Not thread-safe: one caller at
 *  a time; that may be another thread than the one that made it. */
class Network
{
 public:
    Network() = default;
    Network(const Network&) = delete;
    Network& operator=(const Network&) = delete;
    virtual ~Network() = default;

    /** \param blob  1 x 3 x input_height x input_width floats.
     *  \return the outputs of the layers of wanted_layers(), in that order, each 1 x C x H x W or 1
     *  x C floats; they are overwritten by the next call. */
    virtual std::vector<cv::Mat> forward(const cv::Mat& blob) = 0;
};

/** A layer that an option names. Value type. */
struct WantedLayer
{
    std::string key;  ///< of [global_descriptor]
    std::string name;
};

/** The layers of the descriptor, then that of the cells if there is one. */
std::vector<WantedLayer> wanted_layers(const TGlobalDescriptorOptions& options);

/** \param known  the names of the network's layers, in its order.
 *  \throw std::runtime_error  always: the network has no such layer. */
[[noreturn]] void refuse_missing_layer(const WantedLayer& wanted,
                                       const std::vector<std::string>& known,
                                       const TGlobalDescriptorOptions& options);

/** \throw std::runtime_error  always: model_file cannot be read, and why. */
[[noreturn]] void refuse_file(const TGlobalDescriptorOptions& options,
                              const std::runtime_error& reason);

}  // namespace fild
