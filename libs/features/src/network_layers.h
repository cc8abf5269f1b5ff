// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "onnx_graph.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace fild
{
/** Extent of a feature map; a vector of C numbers is C x 1 x 1. Value type. */
struct MapShape
{
    std::int64_t channels = 0;
    std::int64_t rows = 0;
    std::int64_t columns = 0;
};

/** Of a convolution, where its padding depends on the size of the map: ONNX's SAME_UPPER and
 *  SAME_LOWER, which give ceil(size / stride) outputs and put the odd pixel behind or before. */
enum class Padding
{
    as_stated,
    same_odd_behind,
    same_odd_before
};

/** A convolution of maps. Value type. */
struct Convolution
{
    MapShape kernel;  ///< channels: those of the input divided by the groups
    std::int64_t outputs = 0;
    std::int64_t groups = 1;
    std::vector<float> weights;  ///< outputs x kernel
    std::vector<float> bias;  ///< of each output
    std::array<std::int64_t, 2> strides{1, 1};  ///< vertical, horizontal
    std::array<std::int64_t, 2> dilations{1, 1};
    std::array<std::int64_t, 4> pads{};  ///< top, left, bottom, right
    Padding padding = Padding::as_stated;
};

/** A step of a network: clip(f(input) + residual, lower, upper). Value type. */
struct Layer
{
    enum class Kind
    {
        convolution,
        addition,  ///< of its two inputs
        identity,
        mean,  ///< of each channel over the map
        flattening  ///< C x H x W to CHW x 1 x 1
    };
    Kind kind = Kind::identity;
    std::string name;  ///< of the layer in the file, or of the last of those that it stands for
    std::vector<std::string> inputs;  ///< names of values
    std::string output;  ///< name of the value that it computes
    Convolution convolution;
    std::string residual;  ///< name of the value that is added; empty: none
    float lower = -std::numeric_limits<float>::infinity();
    float upper = std::numeric_limits<float>::infinity();
};

/** What has to be computed, in order. Value type. */
struct NetworkLayers
{
    std::string input;  ///< name of the value of the image
    std::vector<Layer> layers;
    std::vector<std::string> outputs;  ///< names of the wanted values
};

/** The layers that the wanted ones depend on, with as little to compute as can be: batch
 *  normalisation is merged with the convolution before it, FILD (IROS 2019) Eq. (1) to (3);
 *  activations and sums are part of the convolution before them.
 *  \param wanted  names of nodes, all of which the graph has.
 *  \throw std::runtime_error when a layer does not fit what it is given, or is of a kind that is
 *  not supported, with its name. */
NetworkLayers needed_layers(const OnnxGraph& graph, const std::vector<std::string>& wanted);

/** Top, left, bottom, right. */
std::array<std::int64_t, 4> pads_of(const Convolution& convolution, const MapShape& input);

/** \param inputs  shapes of layer.inputs and, if there is one, the residual.
 *  \throw std::runtime_error when the layer does not fit them. */
MapShape output_shape(const Layer& layer, const std::vector<MapShape>& inputs);

}  // namespace fild
