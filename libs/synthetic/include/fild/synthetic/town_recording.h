// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/synthetic/synthetic_recording.h"

#include <cstddef>
#include <string>

namespace fild
{
/** A drive through the town that its options describe. Value type. */
struct TownRequest
{
    SyntheticRequest recording;
    std::string birds_eye_path;  ///< of a PNG of town and route from the air; empty: none
    std::size_t threads = 1;  ///< that draw; the result is the same
};

/** Builds the town, drives through it and writes what the sensors see, see
 *  write_synthetic_recording(), and the picture from the air. Neither replaces an existing file.
 *  \throw std::invalid_argument, std::runtime_error as write_synthetic_recording(). */
SyntheticSummary write_town_recording(const TownRequest& request, const OnFrame& on_frame);

}  // namespace fild
