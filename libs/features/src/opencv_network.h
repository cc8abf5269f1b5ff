// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "network.h"

#include <memory>

namespace fild
{
/** An ONNX or Caffe network that runs on OpenCV's dnn module, with cv::getNumThreads() threads, by
 *  which it splits its sums. OpenCV 4.6 crashes on some damaged files, so each is tried in a fork
 *  of this process first.
 *  \param options  whose files are there.
 *  \throw std::runtime_error when the files are no network, it has no such layer, or does not run.
 *  */
std::unique_ptr<Network> read_opencv_network(const TGlobalDescriptorOptions& options);

}  // namespace fild
