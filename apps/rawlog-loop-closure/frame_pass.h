// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/frame.h"
#include "fild/rawlog/input_options.h"

#include <functional>
#include <set>
#include <string>

namespace fild
{
/** Passes over the rawlog again and builds the wanted frames, in their order, up to the last one or
 *  until the user interrupts. \throw std::runtime_error as RawlogReader and FrameBuilder, or when
 *  the image of a frame is gone since the run began. */
void for_each_frame(const std::string& rawlog,
                    const TInputOptions& input,
                    const std::set<FrameId>& wanted,
                    const std::function<void(const Frame&)>& visit);

}  // namespace fild
