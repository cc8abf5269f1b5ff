// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/robot_path_file.h"

#include "fild/core/parse_number.h"
#include "fild/core/words.h"
#include "text_lines.h"

#include <mrpt/math/CQuaternion.h>

#include <array>
#include <charconv>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace fild
{
namespace
{
StampedPose parse_camera_pose(const TextLine& line, const mrpt::math::CQuaternionDouble& turn)
{
    const auto n = parse_numbers(line.text, line.origin);
    if (n.size() != 8)
        throw std::runtime_error(line.origin + ": expected 'seconds x y z qx qy qz qw', got " +
                                 count_of(n.size(), "number"));
    const double norm = std::hypot(std::hypot(n[4], n[5]), std::hypot(n[6], n[7]));
    constexpr double kRounding = 0.01;  // four digits are usual
    if (!(std::abs(norm - 1) < kRounding))
        throw std::runtime_error(line.origin + ": the quaternion's norm is " +
                                 std::to_string(norm) + ", it must be 1");
    const mrpt::math::CQuaternionDouble camera(n[7] / norm, n[4] / norm, n[5] / norm, n[6] / norm);
    mrpt::math::CQuaternionDouble robot;
    robot.crossProduct(camera, turn);
    return {n[0], n[1], n[2], n[3], robot.x(), robot.y(), robot.z(), robot.r()};
}

void write_number(std::ostream& stream, double number)
{
    std::array<char, 512> text{};  // the smallest double has 326 characters before its digits
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    stream.write(text.data(), end.ptr - text.data());
}
}  // namespace

std::vector<StampedPose> read_camera_path(const std::string& path)
{
    // The inverse of robot_from_camera(), without the rounding of its sines.
    const mrpt::math::CQuaternionDouble camera_from_robot(0.5, 0.5, -0.5, 0.5);
    std::vector<StampedPose> poses;
    for (const auto& line : read_text_lines(path))
        poses.push_back(parse_camera_pose(line, camera_from_robot));
    return poses;
}

void write_robot_path(std::ostream& stream, const std::vector<StampedPose>& path)
{
    for (const auto& pose : path)
    {
        write_number(stream, pose.seconds);
        for (const double number : {pose.x, pose.y, pose.z, pose.qx, pose.qy, pose.qz, pose.qw})
        {
            stream << ' ';
            write_number(stream, number);
        }
        stream << '\n';
    }
}

}  // namespace fild
