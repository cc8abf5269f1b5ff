// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/poses_csv.h"

#include "csv_row.h"
#include "fild/core/words.h"

#include <cmath>
#include <cstdint>

namespace fild
{
namespace
{
constexpr const char* kHeader =
    "frame,input_x,input_y,input_z,input_qx,input_qy,input_qz,input_qw,optimized_x,optimized_y,"
    "optimized_z,optimized_qx,optimized_qy,optimized_qz,optimized_qw";
constexpr std::size_t kNumbersOfPose = 7;

FramePose parse_pose(const CsvRow& row, std::size_t first)
{
    constexpr double kMaxLengthError = 0.01;
    const auto number = [&](std::size_t i) { return row.number<double>(first + i); };
    cv::Vec4d quaternion(number(3), number(4), number(5), number(6));
    const double length = cv::norm(quaternion);
    if (std::abs(length - 1) > kMaxLengthError)
        row.fail("columns " + std::to_string(first + 4) + " to " + std::to_string(first + 7) +
                 " are not a unit quaternion");
    quaternion /= length;
    return {rotation_of(quaternion), {number(0), number(1), number(2)}};
}
}  // namespace

RunPoses read_poses_csv(const std::string& path, std::size_t frames)
{
    RunPoses poses{PosesOfFrames(frames), PosesOfFrames(frames)};
    const auto take = [&](const CsvRow& row)
    {
        const auto frame = row.number<std::uint64_t>(0);
        if (frame >= frames)
            row.fail("frame " + row.text(0) + ", the run has " + count_of(frames, "frame") +
                     " from 0");
        poses.input[frame] = parse_pose(row, 1);
        poses.optimized[frame] = parse_pose(row, 1 + kNumbersOfPose);
    };
    for_each_csv_row(path, kHeader, take);
    return poses;
}

}  // namespace fild
