// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/evaluation/frame_poses.h"

#include <cstddef>
#include <string>

namespace fild
{
/** Where the robot was at each frame of a run, before and after the loops. Value type. */
struct RunPoses
{
    PosesOfFrames input;
    PosesOfFrames optimized;
};

/** Reads the poses.csv of a run. Its key is the number of the frame, so that every pose finds its
 *  frame, whatever the time stamps are.
 *  \param frames  of the run.
 *  \throw std::runtime_error naming file and line. */
RunPoses read_poses_csv(const std::string& path, std::size_t frames);

}  // namespace fild
