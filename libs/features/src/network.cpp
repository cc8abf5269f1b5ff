// SPDX-License-Identifier: BSD-3-Clause
#include "network.h"

#include <algorithm>

namespace fild
{
namespace
{
std::string last_of(const std::vector<std::string>& names)
{
    constexpr std::size_t kShown = 8;
    std::string last;
    for (auto i = names.size() - std::min(names.size(), kShown); i < names.size(); ++i)
        last += " '" + names[i] + "'";
    return last;
}
}  // namespace

std::vector<WantedLayer> wanted_layers(const TGlobalDescriptorOptions& options)
{
    std::vector<WantedLayer> wanted;
    for (const auto& name : options.layer_names()) wanted.push_back({"layers", name});
    if (!options.cell_layer.empty()) wanted.push_back({"cell_layer", options.cell_layer});
    return wanted;
}

void refuse_missing_layer(const WantedLayer& wanted,
                          const std::vector<std::string>& known,
                          const TGlobalDescriptorOptions& options)
{
    throw std::runtime_error("[global_descriptor] " + wanted.key + ": " + options.model_file +
                             " has no layer '" + wanted.name + "'; its last are" + last_of(known));
}

void refuse_file(const TGlobalDescriptorOptions& options, const std::runtime_error& reason)
{
    throw std::runtime_error("cannot read " + options.model_file +
                             " as a network: " + reason.what());
}

}  // namespace fild
