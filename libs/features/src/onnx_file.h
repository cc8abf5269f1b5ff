// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/features/global_descriptor_options.h"
#include "network_layers.h"

namespace fild
{
/** What has to be computed for the layers of wanted_layers().
 *  \param options  whose model_file is there.
 *  \throw std::runtime_error when the file is no ONNX network, has no such layer, or one of a kind
 *  that is not supported. */
NetworkLayers read_onnx_layers(const TGlobalDescriptorOptions& options);

}  // namespace fild
