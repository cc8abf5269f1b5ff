// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/verdict.h"
#include "fild/results/csv_columns.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fild
{
/** x, y, z, metres, and qx, qy, qz, qw of a unit quaternion: map from robot. */
using PoseNumbers = std::array<double, 7>;

/** A row of poses.csv: where the robot was at a frame. Value type. */
struct PoseRow
{
    FrameId frame{};
    PoseNumbers input{};  ///< before the loops
    PoseNumbers optimized{};  ///< after them
};

/** `frame,input_x,...,input_qw,optimized_x,...,optimized_qw`, each number with all its digits. A
 *  frame without a pose has no row. */
CsvColumns<PoseRow> poses_csv_columns();

/** The row of each frame of a run, with quaternions of length 1; nothing for a frame without a
 *  pose. The key is the number of the frame, so that every pose finds its frame, whatever the time
 *  stamps are.
 *  \param frames  of the run.
 *  \throw std::runtime_error as read_csv(), and for a frame that the run has not, or a quaternion
 *  that
 *         is not of length 1 within 0.01. */
std::vector<std::optional<PoseRow>> read_poses_csv(const std::string& path, std::size_t frames);

}  // namespace fild
