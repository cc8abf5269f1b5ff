// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawn_drive.h"
#include "rawlog/drawn_rawlog.h"

#include <cstddef>
#include <string>

namespace fild::testing
{
constexpr std::size_t kFramesPerLap = 8;

/** The network of make_tiny_network.py tells little, so all earlier frames are candidates. */
constexpr const char* kTwoLapsConfig =
    "[global_descriptor]\nmodel_file = " FILD_TINY_NETWORK
    "\nlayers = map\ninput_width = 4\ninput_height = 4\npooling = grid\n"
    "[index]\ndelay_seconds = 5\ncandidates = 16\n"
    "[hashing]\nmutual_check = true\n"
    "[consistency]\nconsecutive_frames = 1\n";

/** A camera along a wall, twice, a frame each second. */
inline Objects two_laps(const std::string& label = "CAMERA1")
{
    Objects objects;
    double seconds = 0;
    for (const auto& image : draw_two_laps(kFramesPerLap))
        objects.push_back(image_observation(image, seconds++, label));
    return objects;
}

}  // namespace fild::testing
