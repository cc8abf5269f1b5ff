// SPDX-License-Identifier: BSD-3-Clause
#include "network_layers.h"

#include "message_of.h"

#include <cmath>

namespace
{
using fild::Layer;
using fild::MapShape;
using fild::NetworkLayers;
using fild::OnnxGraph;
using fild::OnnxNode;
using fild::OnnxTensor;
using fild::testing::message_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

OnnxTensor reals(std::vector<std::int64_t> shape, std::vector<float> numbers)
{
    return {std::move(shape), std::move(numbers), {}};
}

/** A node whose name and output are the same. */
OnnxNode node(const std::string& kind, const std::string& name, std::vector<std::string> inputs)
{
    return {name, kind, std::move(inputs), {name}, {}};
}

/** image -> conv (1 x 1, two of three channels) -> bn -> relu, with one more layer of the kind. */
OnnxGraph normalized_convolution()
{
    OnnxGraph graph;
    graph.inputs = {"image"};
    graph.constants = {{"w", reals({2, 3, 1, 1}, {1, 2, 3, 4, 5, 6})},
                       {"b", reals({2}, {1, -1})},
                       {"scale", reals({2}, {2, 3})},
                       {"bias", reals({2}, {0.5F, 0.25F})},
                       {"mean", reals({2}, {1, 2})},
                       {"variance", reals({2}, {3, 15})}};
    graph.nodes = {node("Conv", "conv", {"image", "w", "b"}),
                   node("BatchNormalization", "bn", {"conv", "scale", "bias", "mean", "variance"}),
                   node("Relu", "relu", {"bn"})};
    graph.nodes[1].attributes["epsilon"].real = 1;
    return graph;
}

/** image -> a -> b, both 1 x 1 convolutions of one channel, and their sum. */
OnnxGraph sum_of_two()
{
    OnnxGraph graph;
    graph.inputs = {"image"};
    graph.constants = {{"w", reals({1, 1, 1, 1}, {2})}};
    graph.nodes = {node("Conv", "a", {"image", "w"}),
                   node("Conv", "b", {"a", "w"}),
                   node("Add", "sum", {"a", "b"}),
                   node("Relu", "relu", {"sum"})};
    return graph;
}

std::string error_of(const OnnxGraph& graph, const std::string& wanted)
{
    return message_of<std::runtime_error>([&] { fild::needed_layers(graph, {wanted}); });
}

std::vector<std::string> names_of(const NetworkLayers& network)
{
    std::vector<std::string> names;
    for (const auto& layer : network.layers) names.push_back(layer.name);
    return names;
}

// W_BN is diag(2 / sqrt(3 + 1), 3 / sqrt(15 + 1)) = diag(1, 0.75), b_BN is (0.5 - 1, 0.25 - 1.5).
TEST(NeededLayers, MergeBatchNormalizationWithTheConvolution)
{
    const auto network = fild::needed_layers(normalized_convolution(), {"bn"});
    ASSERT_THAT(names_of(network), ElementsAre("bn"));
    const auto& convolution = network.layers[0].convolution;
    EXPECT_THAT(convolution.weights, ElementsAre(1, 2, 3, 3, 3.75F, 4.5F));
    EXPECT_THAT(convolution.bias, ElementsAre(1 - 0.5F, -0.75F - 1.25F));
    EXPECT_EQ(network.layers[0].output, "bn");
}

TEST(NeededLayers, ComputeActivationsWithTheLayerBefore)
{
    const auto network = fild::needed_layers(normalized_convolution(), {"relu"});
    ASSERT_THAT(names_of(network), ElementsAre("relu"));
    EXPECT_EQ(network.layers[0].lower, 0);
    EXPECT_TRUE(std::isinf(network.layers[0].upper));
}

TEST(NeededLayers, KeepWhatIsWanted)
{
    const auto network = fild::needed_layers(normalized_convolution(), {"relu", "conv", "bn"});
    EXPECT_THAT(names_of(network), ElementsAre("conv", "bn", "relu"));
    EXPECT_THAT(network.outputs, ElementsAre("relu", "conv", "bn"));
    EXPECT_THAT(network.layers[0].convolution.bias, ElementsAre(1, -1));
}

TEST(NeededLayers, EndWithTheLastThatIsWanted)
{
    auto graph = normalized_convolution();
    graph.nodes[2].kind = "Unheard";
    EXPECT_THAT(names_of(fild::needed_layers(graph, {"bn"})), ElementsAre("bn"));
    EXPECT_THAT(error_of(graph, "relu"),
                AllOf(HasSubstr("layer 'relu' is a Unheard"), HasSubstr("backend = opencv")));
}

TEST(NeededLayers, AddWithinTheLaterOfTwoConvolutions)
{
    const auto network = fild::needed_layers(sum_of_two(), {"relu"});
    ASSERT_THAT(names_of(network), ElementsAre("a", "relu"));
    EXPECT_THAT(network.layers[1].inputs, ElementsAre("a"));
    EXPECT_EQ(network.layers[1].residual, "a");
    EXPECT_EQ(network.layers[1].lower, 0);
}

TEST(NeededLayers, DoNotAddBehindAnActivation)
{
    auto graph = sum_of_two();
    graph.nodes.insert(graph.nodes.begin() + 2, node("Relu", "positive", {"b"}));
    graph.nodes[3].inputs[1] = "positive";
    EXPECT_THAT(names_of(fild::needed_layers(graph, {"sum"})), ElementsAre("a", "positive", "sum"));
}

TEST(NeededLayers, ReadBoundsThatAreInputsOrAttributes)
{
    auto graph = normalized_convolution();
    graph.constants["low"] = reals({}, {-1});
    graph.constants["high"] = reals({}, {6});
    graph.nodes[2] = node("Clip", "relu", {"bn", "low", "high"});
    auto layer = fild::needed_layers(graph, {"relu"}).layers[0];
    EXPECT_EQ(layer.lower, -1);
    EXPECT_EQ(layer.upper, 6);
    graph.nodes[2] = node("Clip", "relu", {"bn", ""});
    graph.nodes[2].attributes["max"].real = 5;
    layer = fild::needed_layers(graph, {"relu"}).layers[0];
    EXPECT_TRUE(std::isinf(layer.lower));
    EXPECT_EQ(layer.upper, 5);
    graph.nodes[2].attributes["min"].real = 7;
    EXPECT_THAT(error_of(graph, "relu"), HasSubstr("layer 'relu' clips to"));
}

TEST(NeededLayers, RefuseLayersThatDoNotFitTogether)
{
    auto graph = normalized_convolution();
    graph.constants["mean"] = reals({3}, {1, 2, 3});
    EXPECT_THAT(error_of(graph, "bn"), AllOf(HasSubstr("'bn'"), HasSubstr("'mean'")));
    graph = normalized_convolution();
    graph.nodes[0].inputs[0] = "bn";
    EXPECT_THAT(error_of(graph, "bn"), HasSubstr("'conv' takes 'bn', which no layer before"));
    graph = normalized_convolution();
    graph.nodes[0].attributes["group"].integer = 3;
    EXPECT_THAT(error_of(graph, "conv"), HasSubstr("2 outputs in 3 groups"));
    graph.nodes[0].attributes.clear();
    graph.nodes[0].attributes["strides"].integers = {0, 1};
    EXPECT_THAT(error_of(graph, "conv"), HasSubstr("strides of 0"));
    graph.nodes[0].attributes["strides"].integers = {1};
    EXPECT_THAT(error_of(graph, "conv"), HasSubstr("no two-dimensional strides"));
    graph.inputs.emplace_back("another");
    EXPECT_THAT(error_of(graph, "conv"), HasSubstr("2 inputs"));
}

Layer convolution_of(const MapShape& kernel)
{
    Layer layer;
    layer.kind = Layer::Kind::convolution;
    layer.name = "conv";
    layer.convolution.kernel = kernel;
    layer.convolution.outputs = 5;
    return layer;
}

TEST(OutputShape, CountsStridesDilationsAndPads)
{
    auto layer = convolution_of({2, 3, 3});
    layer.convolution.pads = {0, 1, 2, 3};
    layer.convolution.strides = {2, 1};
    layer.convolution.dilations = {1, 2};
    const auto shape = fild::output_shape(layer, {{2, 9, 10}});
    EXPECT_EQ(shape.channels, 5);
    EXPECT_EQ(shape.rows, (9 + 2 - 3) / 2 + 1);
    EXPECT_EQ(shape.columns, 10 + 4 - 5 + 1);
}

TEST(OutputShape, RefusesMapsThatDoNotFit)
{
    const auto error = [](const Layer& layer, const std::vector<MapShape>& inputs)
    { return message_of<std::runtime_error>([&] { fild::output_shape(layer, inputs); }); };
    EXPECT_THAT(error(convolution_of({2, 3, 3}), {{3, 9, 9}}),
                HasSubstr("'conv' takes 2 channels, and is given a map of 3x9x9"));
    EXPECT_THAT(error(convolution_of({2, 3, 3}), {{2, 2, 9}}), HasSubstr("2x2x9"));
    EXPECT_THAT(error(convolution_of({2, 1, 1}), {{2, 4, 4}, {2, 4, 4}}),
                HasSubstr("adds maps of 5x4x4 and 2x4x4"));
}

// Of 10 rows with a kernel of 3 and a stride of 2 the 5 outputs need one row more, of 9 rows two.
TEST(PadsOf, PutTheOddPixelBehindOrBefore)
{
    auto convolution = convolution_of({1, 3, 3}).convolution;
    convolution.strides = {2, 2};
    convolution.padding = fild::Padding::same_odd_behind;
    EXPECT_THAT(fild::pads_of(convolution, {1, 10, 9}), ElementsAre(0, 1, 1, 1));
    convolution.padding = fild::Padding::same_odd_before;
    EXPECT_THAT(fild::pads_of(convolution, {1, 10, 9}), ElementsAre(1, 1, 0, 1));
}

}  // namespace
