// SPDX-License-Identifier: BSD-3-Clause
#include "fild/features/global_descriptor_options.h"

#include "fild/core/parse_number.h"

#include <sstream>

namespace fild
{
namespace
{
std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}
}  // namespace

std::vector<std::string> TGlobalDescriptorOptions::layer_names() const
{
    return split(layers);
}

std::array<double, 3> TGlobalDescriptorOptions::channel_means() const
{
    std::vector<double> numbers;
    for (const auto& word : split(mean))
    {
        const auto number = parse_number<double>(word);
        if (!number)
            throw std::invalid_argument("mean='" + mean + "': '" + word + "' is not a number");
        numbers.push_back(*number);
    }
    if (numbers.size() == 1) return {numbers[0], numbers[0], numbers[0]};
    if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
    throw std::invalid_argument("mean='" + mean + "' is neither one number nor three");
}

void TGlobalDescriptorOptions::describe(OptionVisitor& visitor)
{
    visitor.text("model_file", model_file);
    visitor.text("caffe_prototxt_file", caffe_prototxt_file);
    visitor.choice<Backend>(
        "backend", backend, {{"onednn", Backend::onednn}, {"opencv", Backend::opencv}});
    visitor.choice<Precision>(
        "precision",
        precision,
        {{"f32", Precision::f32}, {"mixed", Precision::mixed}, {"bf16", Precision::bf16}});
    visitor.text("layers", layers);
    visitor.text("cell_layer", cell_layer);
    visitor.integer("input_width", input_width, 1, 10000);
    visitor.integer("input_height", input_height, 1, 10000);
    visitor.text("mean", mean);
    visitor.real("scale", scale, 1e-9, 1e9);
    visitor.choice<ChannelOrder>(
        "channel_order", channel_order, {{"rgb", ChannelOrder::rgb}, {"bgr", ChannelOrder::bgr}});
    visitor.choice<Pooling>(
        "pooling",
        pooling,
        {{"average", Pooling::average}, {"gem", Pooling::gem}, {"grid", Pooling::grid}});
    visitor.real("gem_power", gem_power, 1, 100);
    visitor.integer("grid_rows", grid_rows, 1, 100);
    visitor.integer("grid_columns", grid_columns, 1, 100);
    visitor.integer("dimension", dimension, 0, 10000000);
}

void TGlobalDescriptorOptions::check_between_fields() const
{
    if (model_file.empty()) throw std::invalid_argument("model_file is empty");
    if (layer_names().empty()) throw std::invalid_argument("layers names no output layer");
    channel_means();
    if (backend == Backend::onednn && !caffe_prototxt_file.empty())
        throw std::invalid_argument(
            "caffe_prototxt_file is set, but backend = onednn reads ONNX files only; set backend = "
            "opencv");
    if (backend == Backend::opencv && precision != Precision::f32)
        throw std::invalid_argument(
            "backend = opencv has precision = f32 only; mixed and bf16 need backend = onednn");
}

}  // namespace fild
