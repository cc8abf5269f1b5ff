// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/core/frame.h"
#include "fild/core/whole_file.h"

#include <array>
#include <string>

namespace fild
{
/** Writes where the robot was at each frame as rows of a CSV file that appears when it is whole:
 *
 *  `frame,input_x,input_y,input_z,input_qx,input_qy,input_qz,input_qw,optimized_x,...,optimized_qw`
 *
 *  input is the pose before the loops, optimized the one after them: metres and a unit quaternion,
 *  each number with all its digits. A frame without a pose has no row. read_poses_csv() reads it.
 *  Not thread-safe: one caller at a time. */
class PoseCsv
{
 public:
    /** x, y, z, metres, and qx, qy, qz, qw of a unit quaternion: map from robot. */
    using PoseNumbers = std::array<double, 7>;

    /** \throw std::runtime_error as WholeFile. */
    explicit PoseCsv(const std::string& path);

    void add(FrameId frame, const PoseNumbers& input, const PoseNumbers& optimized);

    /** \throw std::runtime_error when a row could not be written. */
    void commit() { file_.commit(); }

 private:
    WholeFile file_;
};

}  // namespace fild
