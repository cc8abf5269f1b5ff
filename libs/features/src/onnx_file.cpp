// SPDX-License-Identifier: BSD-3-Clause
#include "onnx_file.h"

#include "network.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 29U;

std::string read_file(const std::string& path)
{
    if (std::filesystem::file_size(path) > kMaxFileBytes)
        throw std::runtime_error("it has more than 512 MB");
    std::ifstream file(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (file.bad() || !file.is_open()) throw std::runtime_error("the file cannot be read");
    return bytes;
}

OnnxGraph read_graph(const TGlobalDescriptorOptions& options)
{
    try
    {
        return parse_onnx(read_file(options.model_file));
    }
    catch (const std::runtime_error& error)
    {
        refuse_file(options, error);
    }
}

std::vector<std::string> find_layers(const OnnxGraph& graph,
                                     const TGlobalDescriptorOptions& options)
{
    std::vector<std::string> known;
    for (const auto& node : graph.nodes) known.push_back(node.name);
    std::vector<std::string> found;
    for (const auto& wanted : wanted_layers(options))
    {
        if (std::find(known.begin(), known.end(), wanted.name) == known.end())
            refuse_missing_layer(wanted, known, options);
        found.push_back(wanted.name);
    }
    return found;
}
}  // namespace

NetworkLayers read_onnx_layers(const TGlobalDescriptorOptions& options)
{
    const auto graph = read_graph(options);
    const auto layers = find_layers(graph, options);
    try
    {
        return needed_layers(graph, layers);
    }
    catch (const std::runtime_error& error)
    {
        refuse_file(options, error);
    }
}

}  // namespace fild
