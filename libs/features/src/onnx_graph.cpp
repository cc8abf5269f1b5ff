// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the fields are those of onnx.proto, https://github.com/onnx/onnx.
#include "onnx_graph.h"

#include "protobuf_reader.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace fild
{
namespace
{
/** TensorProto, as far as it is used. */
struct StoredTensor
{
    std::string name;
    OnnxTensor tensor;
    std::int64_t type = 0;
    std::string_view raw;
    bool elsewhere = false;
};

constexpr std::int64_t kFloat = 1;
constexpr std::int64_t kInt64 = 7;

StoredTensor parse_fields(std::string_view bytes)
{
    StoredTensor stored;
    ProtobufReader reader(bytes);
    while (reader.next())
    {
        if (reader.field() == 1) reader.append_to(stored.tensor.shape);
        if (reader.field() == 2) stored.type = reader.integer();
        if (reader.field() == 4) reader.append_to(stored.tensor.reals);
        if (reader.field() == 7) reader.append_to(stored.tensor.integers);
        if (reader.field() == 8) stored.name = reader.bytes();
        if (reader.field() == 9) stored.raw = reader.bytes();
        if (reader.field() == 14) stored.elsewhere = reader.integer() != 0;
    }
    return stored;
}

/** How many numbers a shape has; more than any memory holds when it is damaged. */
std::uint64_t size_of(const std::vector<std::int64_t>& shape)
{
    constexpr std::uint64_t kTooMany = std::uint64_t{1} << 62U;
    std::uint64_t size = 1;
    for (const auto extent : shape)
    {
        if (extent < 0) return kTooMany;
        if (extent > 0 && size > kTooMany / static_cast<std::uint64_t>(extent)) return kTooMany;
        size *= static_cast<std::uint64_t>(extent);
    }
    return size;
}

std::pair<std::string, OnnxTensor> parse_tensor(std::string_view bytes)
{
    auto stored = parse_fields(bytes);
    auto& tensor = stored.tensor;
    if (stored.elsewhere)
        throw std::runtime_error("the numbers of '" + stored.name +
                                 "' are in another file; save the model as one file");
    if (stored.type == kFloat && !stored.raw.empty()) tensor.reals = to_numbers<float>(stored.raw);
    if (stored.type == kInt64 && !stored.raw.empty())
        tensor.integers = to_numbers<std::int64_t>(stored.raw);
    if (stored.type != kFloat) tensor.reals.clear();
    if (stored.type != kInt64) tensor.integers.clear();
    const auto count = std::max(tensor.reals.size(), tensor.integers.size());
    if ((stored.type == kFloat || stored.type == kInt64) && count != size_of(tensor.shape))
        throw std::runtime_error("'" + stored.name + "' has " + std::to_string(count) +
                                 " numbers, its shape asks for others");
    return {std::move(stored.name), std::move(tensor)};
}

std::pair<std::string, OnnxAttribute> parse_attribute(std::string_view bytes)
{
    std::pair<std::string, OnnxAttribute> named;
    auto& [name, attribute] = named;
    ProtobufReader reader(bytes);
    while (reader.next())
    {
        if (reader.field() == 1) name = reader.bytes();
        if (reader.field() == 2) attribute.real = reader.real();
        if (reader.field() == 3) attribute.integer = reader.integer();
        if (reader.field() == 4) attribute.text = reader.bytes();
        if (reader.field() == 5) attribute.tensor = parse_tensor(reader.bytes()).second;
        if (reader.field() == 7) reader.append_to(attribute.reals);
        if (reader.field() == 8) reader.append_to(attribute.integers);
    }
    return named;
}

OnnxNode parse_node(std::string_view bytes)
{
    OnnxNode node;
    std::string domain;
    ProtobufReader reader(bytes);
    while (reader.next())
    {
        if (reader.field() == 1) node.inputs.emplace_back(reader.bytes());
        if (reader.field() == 2) node.outputs.emplace_back(reader.bytes());
        if (reader.field() == 3) node.name = reader.bytes();
        if (reader.field() == 4) node.kind = reader.bytes();
        if (reader.field() == 5) node.attributes.insert(parse_attribute(reader.bytes()));
        if (reader.field() == 7) domain = reader.bytes();
    }
    if (node.outputs.empty()) throw std::runtime_error("layer '" + node.name + "' has no output");
    if (node.name.empty()) node.name = node.outputs.front();
    if (!domain.empty() && domain != "ai.onnx") node.kind = domain + "." + node.kind;
    return node;
}

/** ValueInfoProto. */
std::string parse_name(std::string_view bytes)
{
    std::string name;
    ProtobufReader reader(bytes);
    while (reader.next())
        if (reader.field() == 1) name = reader.bytes();
    return name;
}

/** A constant may be stored as a node that computes it. */
void keep_node(OnnxNode node, OnnxGraph& graph)
{
    const auto value = node.attributes.find("value");
    if (node.kind == "Constant" && value != node.attributes.end() && value->second.tensor)
        graph.constants.insert({node.outputs.front(), *std::move(value->second.tensor)});
    else
        graph.nodes.push_back(std::move(node));
}

OnnxGraph parse_graph(std::string_view bytes)
{
    OnnxGraph graph;
    ProtobufReader reader(bytes);
    while (reader.next())
    {
        if (reader.field() == 1) keep_node(parse_node(reader.bytes()), graph);
        if (reader.field() == 5) graph.constants.insert(parse_tensor(reader.bytes()));
        if (reader.field() == 11) graph.inputs.push_back(parse_name(reader.bytes()));
    }
    const auto is_constant = [&](const std::string& name)
    { return graph.constants.count(name) > 0; };
    auto& inputs = graph.inputs;  // older files list the constants as well
    inputs.erase(std::remove_if(inputs.begin(), inputs.end(), is_constant), inputs.end());
    return graph;
}
}  // namespace

OnnxGraph parse_onnx(std::string_view bytes)
{
    std::optional<OnnxGraph> graph;
    ProtobufReader reader(bytes);
    while (reader.next())
        if (reader.field() == 7) graph = parse_graph(reader.bytes());
    if (!graph || graph->nodes.empty()) throw std::runtime_error("it holds no network");
    return *std::move(graph);
}

}  // namespace fild
