// SPDX-License-Identifier: BSD-3-Clause
// Merging batch normalisation with convolutions, FILD (An et al., IROS 2019), Eq. (1) to (3).
#include "network_layers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
[[noreturn]] void refuse(const std::string& layer, const std::string& reason)
{
    throw std::runtime_error("layer '" + layer + "' " + reason);
}

[[noreturn]] void refuse_unsupported(const std::string& layer, const std::string& what)
{
    refuse(
        layer,
        what +
            ", which backend = onednn does not support; set [global_descriptor] backend = opencv");
}

std::string to_text(const MapShape& shape)
{
    return std::to_string(shape.channels) + "x" + std::to_string(shape.rows) + "x" +
           std::to_string(shape.columns);
}

/** A node with the constants of its graph. */
class NodeReader
{
 public:
    NodeReader(const OnnxNode& node, const OnnxGraph& graph) : node_(node), graph_(graph) {}

    const OnnxNode& node() const { return node_; }

    bool has_input(std::size_t i) const
    {
        return i < node_.inputs.size() && !node_.inputs[i].empty();
    }

    /** The name of a value that is computed. */
    const std::string& value(std::size_t i) const
    {
        if (!has_input(i)) refuse(node_.name, "has too few inputs");
        if (graph_.constants.count(node_.inputs[i]) > 0)
            refuse_unsupported(node_.name, "is a " + node_.kind + " of a constant");
        return node_.inputs[i];
    }

    const OnnxTensor& constant(std::size_t i) const
    {
        if (!has_input(i)) refuse(node_.name, "has too few inputs");
        const auto found = graph_.constants.find(node_.inputs[i]);
        if (found == graph_.constants.end())
            refuse(
                node_.name,
                "takes '" + node_.inputs[i] + "' for a constant, which is not stored in the file");
        return found->second;
    }

    /** A constant of `count` real numbers. */
    const std::vector<float>& reals(std::size_t i, std::int64_t count) const
    {
        const auto& reals = constant(i).reals;
        if (reals.size() != static_cast<std::size_t>(count))
            refuse(node_.name,
                   "takes '" + node_.inputs[i] + "', which is not " + std::to_string(count) +
                       " float32 numbers");
        return reals;
    }

    const OnnxAttribute* attribute(const std::string& name) const
    {
        const auto found = node_.attributes.find(name);
        return found == node_.attributes.end() ? nullptr : &found->second;
    }

    std::int64_t integer(const std::string& name, std::int64_t otherwise) const
    {
        const auto* found = attribute(name);
        return found == nullptr ? otherwise : found->integer;
    }

    float real(const std::string& name, float otherwise) const
    {
        const auto* found = attribute(name);
        return found == nullptr ? otherwise : found->real;
    }

    /** Small numbers of a convolution. */
    template <std::size_t Count>
    void read(const std::string& name,
              std::int64_t least,
              std::array<std::int64_t, Count>& numbers) const
    {
        constexpr std::int64_t kMost = 1024;
        const auto* found = attribute(name);
        if (found == nullptr) return;
        const auto& given = found->integers;
        if (given.size() != Count) refuse_unsupported(node_.name, "has no two-dimensional " + name);
        for (const auto number : given)
            if (number < least || number > kMost)
                refuse(node_.name,
                       "has " + name + " of " + std::to_string(number) + ", outside [" +
                           std::to_string(least) + ", " + std::to_string(kMost) + "]");
        std::copy(given.begin(), given.end(), numbers.begin());
    }

    Layer layer(Layer::Kind kind, std::vector<std::string> inputs) const
    {
        Layer layer;
        layer.kind = kind;
        layer.name = node_.name;
        layer.inputs = std::move(inputs);
        layer.output = node_.outputs.front();
        return layer;
    }

 private:
    const OnnxNode& node_;
    const OnnxGraph& graph_;
};

Padding padding_of(const NodeReader& reader)
{
    const auto* attribute = reader.attribute("auto_pad");
    const auto word = attribute == nullptr ? "NOTSET" : attribute->text;
    if (word == "NOTSET" || word == "VALID" || word.empty()) return Padding::as_stated;
    if (word == "SAME_UPPER") return Padding::same_odd_behind;
    if (word == "SAME_LOWER") return Padding::same_odd_before;
    refuse(reader.node().name, "has auto_pad '" + word + "'");
}

Layer read_convolution(const NodeReader& reader)
{
    auto layer = reader.layer(Layer::Kind::convolution, {reader.value(0)});
    auto& convolution = layer.convolution;
    const auto& weights = reader.constant(1);
    if (weights.shape.size() != 4 || weights.reals.empty())
        refuse_unsupported(layer.name, "has weights that are not four-dimensional float32");
    convolution.outputs = weights.shape[0];
    convolution.kernel = {weights.shape[1], weights.shape[2], weights.shape[3]};
    convolution.weights = weights.reals;
    if (reader.has_input(2))
        convolution.bias = reader.reals(2, convolution.outputs);
    else
        convolution.bias.assign(static_cast<std::size_t>(convolution.outputs), 0.0F);
    convolution.groups = reader.integer("group", 1);
    if (convolution.groups < 1 || convolution.outputs % convolution.groups != 0)
        refuse(layer.name,
               "has " + std::to_string(convolution.outputs) + " outputs in " +
                   std::to_string(convolution.groups) + " groups");
    reader.read("strides", 1, convolution.strides);
    reader.read("dilations", 1, convolution.dilations);
    reader.read("pads", 0, convolution.pads);
    convolution.padding = padding_of(reader);
    return layer;
}

/** As the 1 x 1 convolution of each channel by itself that it is: W_BN and b_BN of Eq. (1). */
Layer read_batch_normalization(const NodeReader& reader)
{
    auto layer = reader.layer(Layer::Kind::convolution, {reader.value(0)});
    const auto channels = static_cast<std::int64_t>(reader.constant(1).reals.size());
    const auto& scale = reader.reals(1, channels);
    const auto& bias = reader.reals(2, channels);
    const auto& mean = reader.reals(3, channels);
    const auto& variance = reader.reals(4, channels);
    const double epsilon = reader.real("epsilon", 1e-5F);
    auto& convolution = layer.convolution;
    convolution.kernel = {1, 1, 1};
    convolution.outputs = convolution.groups = channels;
    if (channels == 0) refuse(layer.name, "has no channels");
    for (std::size_t i = 0; i < scale.size(); ++i)
    {
        const double weight = scale[i] / std::sqrt(variance[i] + epsilon);
        convolution.weights.push_back(static_cast<float>(weight));
        convolution.bias.push_back(static_cast<float>(bias[i] - weight * mean[i]));
    }
    return layer;
}

Layer read_relu(const NodeReader& reader)
{
    auto layer = reader.layer(Layer::Kind::identity, {reader.value(0)});
    layer.lower = 0;
    return layer;
}

/** The bounds are attributes up to operator set 10, inputs later. */
Layer read_clip(const NodeReader& reader)
{
    auto layer = reader.layer(Layer::Kind::identity, {reader.value(0)});
    layer.lower = reader.has_input(1) ? reader.reals(1, 1)[0] : reader.real("min", layer.lower);
    layer.upper = reader.has_input(2) ? reader.reals(2, 1)[0] : reader.real("max", layer.upper);
    if (!(layer.lower <= layer.upper))
        refuse(
            layer.name,
            "clips to [" + std::to_string(layer.lower) + ", " + std::to_string(layer.upper) + "]");
    return layer;
}

Layer read_addition(const NodeReader& reader)
{
    return reader.layer(Layer::Kind::addition, {reader.value(0), reader.value(1)});
}

Layer read_identity(const NodeReader& reader)
{
    return reader.layer(Layer::Kind::identity, {reader.value(0)});
}

Layer read_mean(const NodeReader& reader)
{
    return reader.layer(Layer::Kind::mean, {reader.value(0)});
}

/** The axes are an attribute up to operator set 17, an input later. */
Layer read_reduced_mean(const NodeReader& reader)
{
    auto axes = reader.attribute("axes") != nullptr ? reader.attribute("axes")->integers
                                                    : std::vector<std::int64_t>{};
    if (reader.has_input(1)) axes = reader.constant(1).integers;
    for (auto& axis : axes)
        if (axis < 0) axis += 4;
    std::sort(axes.begin(), axes.end());
    if (axes != std::vector<std::int64_t>{2, 3})
        refuse_unsupported(reader.node().name, "is a ReduceMean over other than rows and columns");
    return read_mean(reader);
}

Layer read_flattening(const NodeReader& reader)
{
    if (reader.integer("axis", 1) != 1)
        refuse_unsupported(reader.node().name, "is a Flatten whose axis is not 1");
    return reader.layer(Layer::Kind::flattening, {reader.value(0)});
}

Layer read_reshape(const NodeReader& reader)
{
    const auto& shape = reader.constant(1).integers;
    if (shape.size() != 2 || shape[0] < -1 || shape[0] > 1)
        refuse_unsupported(reader.node().name, "is a Reshape to other than a vector");
    return reader.layer(Layer::Kind::flattening, {reader.value(0)});
}

struct KindReader
{
    std::string_view kind;
    Layer (*read)(const NodeReader&);
};

constexpr std::array<KindReader, 11> kReaders{{{"Add", read_addition},
                                               {"BatchNormalization", read_batch_normalization},
                                               {"Clip", read_clip},
                                               {"Conv", read_convolution},
                                               {"Dropout", read_identity},
                                               {"Flatten", read_flattening},
                                               {"GlobalAveragePool", read_mean},
                                               {"Identity", read_identity},
                                               {"ReduceMean", read_reduced_mean},
                                               {"Relu", read_relu},
                                               {"Reshape", read_reshape}}};

Layer read_layer(const OnnxNode& node, const OnnxGraph& graph)
{
    const auto* const found = std::find_if(
        kReaders.begin(), kReaders.end(), [&](const auto& each) { return each.kind == node.kind; });
    if (found == kReaders.end()) refuse_unsupported(node.name, "is a " + node.kind);
    return found->read(NodeReader(node, graph));
}

/** Names of the first outputs of the nodes that are called so. */
std::vector<std::string> values_of(const OnnxGraph& graph, const std::vector<std::string>& wanted)
{
    std::vector<std::string> values;
    for (const auto& name : wanted)
    {
        const auto found = std::find_if(graph.nodes.begin(),
                                        graph.nodes.end(),
                                        [&](const OnnxNode& node) { return node.name == name; });
        values.push_back(found->outputs.front());
    }
    return values;
}

/** The nodes that the values depend on, in order. */
std::vector<const OnnxNode*> needed_nodes(const OnnxGraph& graph,
                                          const std::vector<std::string>& values)
{
    std::set<std::string> needed(values.begin(), values.end());
    std::vector<const OnnxNode*> nodes;
    for (auto node = graph.nodes.rbegin(); node != graph.nodes.rend(); ++node)
    {
        const auto is_needed = [&](const std::string& value) { return needed.count(value) > 0; };
        if (std::none_of(node->outputs.begin(), node->outputs.end(), is_needed)) continue;
        needed.insert(node->inputs.begin(), node->inputs.end());
        nodes.push_back(&*node);
    }
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
}

/** ONNX has its nodes in an order in which they can be computed. */
void check_order(const NetworkLayers& network)
{
    std::set<std::string> computed{network.input};
    for (const auto& layer : network.layers)
    {
        for (const auto& input : layer.inputs)
            if (computed.count(input) == 0)
                refuse(layer.name, "takes '" + input + "', which no layer before it computes");
        if (!computed.insert(layer.output).second)
            refuse(layer.name, "computes '" + layer.output + "' a second time");
    }
}

/** Puts layers into those before them. */
class LayerFusion
{
 public:
    explicit LayerFusion(const NetworkLayers& network)
    {
        for (const auto& layer : network.layers)
            for (const auto& input : layer.inputs) ++uses_[input];
        for (const auto& output : network.outputs) ++uses_[output];
        for (const auto& layer : network.layers)
            if (!fuse(layer)) append(layer);
    }

    std::vector<Layer> layers() && { return std::move(fused_); }

 private:
    void append(const Layer& layer)
    {
        places_[layer.output] = fused_.size();
        fused_.push_back(layer);
    }

    /** The layer that computes a value for one other layer alone; none when others need it, too. */
    Layer* maker_of(const std::string& value)
    {
        const auto place = places_.find(value);
        return place == places_.end() || uses_[value] > 1 ? nullptr : &fused_[place->second];
    }

    bool fuse(const Layer& layer)
    {
        if (layer.kind == Layer::Kind::addition)
            return fuse_addition(layer, 0) || fuse_addition(layer, 1);
        auto* const before = maker_of(layer.inputs.front());
        if (before == nullptr) return false;
        if (layer.kind == Layer::Kind::identity) return fuse_clip(layer, *before);
        if (layer.kind == Layer::Kind::convolution) return fuse_scaling(layer, *before);
        return false;
    }

    /** The layer before takes the place of both. */
    bool replace(const Layer& layer, Layer& before)
    {
        places_[layer.output] = places_.at(before.output);
        before.name = layer.name;
        before.output = layer.output;
        return true;
    }

    bool fuse_clip(const Layer& layer, Layer& before)
    {
        if (before.kind == Layer::Kind::mean || before.kind == Layer::Kind::flattening)
            return false;
        before.lower = std::clamp(before.lower, layer.lower, layer.upper);
        before.upper = std::clamp(before.upper, layer.lower, layer.upper);
        return replace(layer, before);
    }

    static bool is_bare_convolution(const Layer& layer)
    {
        return layer.kind == Layer::Kind::convolution && layer.residual.empty() &&
               layer.lower == Layer().lower && layer.upper == Layer().upper;
    }

    /** Each channel times a number plus another. */
    static bool is_scaling(const Convolution& c)
    {
        return c.kernel.channels == 1 && c.kernel.rows == 1 && c.kernel.columns == 1 &&
               c.groups == c.outputs && c.strides == std::array<std::int64_t, 2>{1, 1} &&
               c.pads == std::array<std::int64_t, 4>{};
    }

    /** Eq. (2) and (3), where W_BN is diagonal. */
    bool fuse_scaling(const Layer& layer, Layer& before)
    {
        const auto& scaling = layer.convolution;
        auto& convolution = before.convolution;
        if (!is_bare_convolution(before) || !is_scaling(scaling) ||
            scaling.outputs != convolution.outputs)
            return false;
        const auto of_each = convolution.weights.size() / convolution.bias.size();
        for (std::size_t i = 0; i < convolution.weights.size(); ++i)
            convolution.weights[i] *= scaling.weights[i / of_each];
        for (std::size_t i = 0; i < convolution.bias.size(); ++i)
            convolution.bias[i] = scaling.weights[i] * convolution.bias[i] + scaling.bias[i];
        return replace(layer, before);
    }

    /** Adds one input to the convolution that computes the other, when that comes later. */
    bool fuse_addition(const Layer& layer, std::size_t with)
    {
        const auto& added = layer.inputs[1 - with];
        auto* const before = maker_of(layer.inputs[with]);
        if (before == nullptr || !is_bare_convolution(*before)) return false;
        const auto place = places_.find(added);
        if (place == places_.end() || place->second >= places_.at(before->output)) return false;
        before->residual = added;
        return replace(layer, *before);
    }

    std::map<std::string, int> uses_;
    std::vector<Layer> fused_;
    std::map<std::string, std::size_t> places_;  ///< of the layer that computes a value, in fused_
};
}  // namespace

NetworkLayers needed_layers(const OnnxGraph& graph, const std::vector<std::string>& wanted)
{
    NetworkLayers network;
    if (graph.inputs.size() != 1)
        throw std::runtime_error("it has " + std::to_string(graph.inputs.size()) +
                                 " inputs, not one image");
    network.input = graph.inputs.front();
    network.outputs = values_of(graph, wanted);
    for (const auto* node : needed_nodes(graph, network.outputs))
        network.layers.push_back(read_layer(*node, graph));
    check_order(network);
    network.layers = LayerFusion(network).layers();
    return network;
}

namespace
{
/** How many pixels a kernel spans. */
std::int64_t span_of(std::int64_t kernel, std::int64_t dilation)
{
    return (kernel - 1) * dilation + 1;
}

MapShape convolved_shape(const Layer& layer, const MapShape& input)
{
    const auto& c = layer.convolution;
    if (c.kernel.channels * c.groups != input.channels)
        refuse(layer.name,
               "takes " + std::to_string(c.kernel.channels * c.groups) +
                   " channels, and is given a map of " + to_text(input));
    const auto pads = pads_of(c, input);
    const auto rows = input.rows + pads[0] + pads[2] - span_of(c.kernel.rows, c.dilations[0]);
    const auto columns =
        input.columns + pads[1] + pads[3] - span_of(c.kernel.columns, c.dilations[1]);
    if (rows < 0 || columns < 0)
        refuse(layer.name, "has a kernel larger than its map of " + to_text(input));
    return {c.outputs, rows / c.strides[0] + 1, columns / c.strides[1] + 1};
}
}  // namespace

std::array<std::int64_t, 4> pads_of(const Convolution& convolution, const MapShape& input)
{
    if (convolution.padding == Padding::as_stated) return convolution.pads;
    const auto pad = [&](std::int64_t size, std::int64_t kernel, std::size_t axis)
    {
        const auto stride = convolution.strides[axis];
        const auto outputs = (size + stride - 1) / stride;
        const auto total = std::max<std::int64_t>(
            (outputs - 1) * stride + span_of(kernel, convolution.dilations[axis]) - size, 0);
        const auto before =
            convolution.padding == Padding::same_odd_behind ? total / 2 : total - total / 2;
        return std::pair{before, total - before};
    };
    const auto [top, bottom] = pad(input.rows, convolution.kernel.rows, 0);
    const auto [left, right] = pad(input.columns, convolution.kernel.columns, 1);
    return {top, left, bottom, right};
}

MapShape output_shape(const Layer& layer, const std::vector<MapShape>& inputs)
{
    const auto& input = inputs.front();
    auto output = input;
    if (layer.kind == Layer::Kind::convolution) output = convolved_shape(layer, input);
    if (layer.kind == Layer::Kind::mean) output = {input.channels, 1, 1};
    if (layer.kind == Layer::Kind::flattening)
        output = {input.channels * input.rows * input.columns, 1, 1};
    for (std::size_t i = 1; i < inputs.size(); ++i)
        if (to_text(inputs[i]) != to_text(output))
            refuse_unsupported(layer.name,
                               "adds maps of " + to_text(output) + " and " + to_text(inputs[i]));
    return output;
}

}  // namespace fild
