// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/descriptors.h"
#include "fild/core/verdict.h"

#include <stdexcept>
#include <string>

namespace fild
{
/** \throw std::invalid_argument when the descriptor's length is not the index's. */
inline void require_dimension(const GlobalDescriptor& descriptor, std::size_t dimension)
{
    if (descriptor.size() != dimension)
        throw std::invalid_argument("the index holds descriptors of " + std::to_string(dimension) +
                                    " numbers, this one has " + std::to_string(descriptor.size()));
}

[[noreturn]] inline void throw_not_in_index(FrameId frame)
{
    throw std::invalid_argument("frame " + std::to_string(to_index(frame)) +
                                " is not in the index");
}

}  // namespace fild
