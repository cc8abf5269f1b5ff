// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "network.h"

#include <memory>

namespace fild
{
/** Whether the processor has instructions for bfloat16; others can at most imitate it, slower than
 *  float32. */
bool processor_has_bf16();

/** An ONNX network that runs on oneDNN, of the layers of wanted_layers() and those before them
 *  only. It works in the thread that calls it and starts no others. Kinds of processors round
 *  differently.
 *  \param options  whose model_file is there.
 *  \throw std::runtime_error when the file is not a network, lacks a wanted layer, has an unsupported
 *         one, or needs more than 512 MB for maps at the size of the input. */
std::unique_ptr<Network> read_onednn_network(const TGlobalDescriptorOptions& options);

}  // namespace fild
