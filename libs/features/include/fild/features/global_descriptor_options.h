// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/options.h"

#include <array>
#include <string>
#include <vector>

namespace fild
{
/** How the feature map of a layer becomes a vector. */
enum class Pooling
{
    average,  ///< mean over the image: the paper's
    gem,  ///< generalised mean, the gem_power-th root of the mean of the gem_power-th powers
    grid  ///< mean over each cell of grid_rows x grid_columns, each cell normalised, concatenated
};

/** What the network runs on. */
enum class Backend
{
    onednn,  ///< ONNX files of the operators that MobileNetV2 has; several times as fast
    opencv  ///< OpenCV's dnn module: ONNX and Caffe files, many more operators
};

/** Of the numbers between the layers of the network; sums are in float32. All but f32 need
 *  Backend::onednn and a processor with bfloat16 (AVX-512 BF16). */
enum class Precision
{
    f32,
    mixed,  ///< bf16 in maps that are smaller than an eighth of the image
    bf16
};

enum class ChannelOrder
{
    rgb,
    bgr
};

/** Section [global_descriptor]: the network, what it is fed and what is taken out of it. */
struct TGlobalDescriptorOptions : Options
{
    /** ONNX, or Caffe's weights. A name without folder is looked for in the current folder, then in
     *  the one that datasets-scripts/get-model.sh fills. */
    std::string model_file = "mobilenet_v2_objectron.onnx";
    /** Caffe's network description; empty: model_file is ONNX. Backend::opencv only. */
    std::string caffe_prototxt_file;
    Backend backend = Backend::onednn;
    Precision precision = Precision::f32;
    /** Output layers, separated by blanks; their pooled vectors are normalised and concatenated. */
    std::string layers = "FeatureExtractor/MobilenetV2/Conv_1/Relu6";
    /** Layer whose cells are compared one by one, beside the descriptor of the whole image; empty:
     *  none, as in the paper. */
    std::string cell_layer;
    int input_width = 300;  ///< pixels; images are resized to it, whatever their aspect
    int input_height = 300;
    std::string mean =
        "127.5";  ///< subtracted from 8 bit pixels: one number, or one a channel in channel_order
    double scale = 1 / 127.5;  ///< multiplied after the subtraction
    ChannelOrder channel_order = ChannelOrder::rgb;
    Pooling pooling = Pooling::average;
    double gem_power = 3;
    int grid_rows = 2;
    int grid_columns = 2;
    /** Length that the descriptor must have; 0 accepts any. Guards against a mixed-up model. */
    int dimension = 0;

    std::vector<std::string> layer_names() const;
    std::array<double, 3> channel_means() const;

 protected:
    void describe(OptionVisitor& visitor) override;
    void check_between_fields() const override;
};

}  // namespace fild
