// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/calibration_file.h"

#include "fild/core/frame.h"
#include "fild/core/parse_number.h"
#include "fild/rawlog/pose_conversion.h"
#include "text_lines.h"

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DQuat.h>

#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
double parse_baseline(const TextLine& line)
{
    const std::string word = "baseline";
    if (line.text.compare(0, word.size(), word) != 0)
        throw std::runtime_error(line.origin + ": '" + line.text +
                                 "' follows the camera's line; only 'baseline METRES' may");
    const auto metres = parse_number<double>(trim(line.text.substr(word.size())));
    if (!metres || *metres <= 0)
        throw std::runtime_error(line.origin + ": '" + line.text +
                                 "' is not of the form 'baseline METRES', METRES above 0");
    return *metres;
}

/** What stands behind a word at the beginning of the line; nothing for another word. */
std::optional<std::string> text_behind(const std::string& word, const TextLine& line)
{
    const auto end = line.text.find_first_of(" \t");
    if (line.text.substr(0, end) != word) return std::nullopt;
    return end == std::string::npos ? "" : line.text.substr(end);
}

RigidTransform parse_right_pose(const std::string& text, const TextLine& line)
{
    const auto numbers = parse_numbers(text, line.origin);
    constexpr double kRoundedLength = 1e-3;
    double squares = 0;
    for (std::size_t i = 3; i < numbers.size(); ++i) squares += numbers[i] * numbers[i];
    if (numbers.size() != 7 || !(std::abs(squares - 1) < kRoundedLength))
        throw std::runtime_error(line.origin + ": '" + line.text +
                                 "' is not of the form 'right_pose X Y Z QX QY QZ QW' with a unit "
                                 "quaternion");
    const auto& n = numbers;
    const mrpt::math::CQuaternionDouble quaternion(n[6], n[3], n[4], n[5]);
    auto pose = rigid_transform_from(
        mrpt::poses::CPose3D(mrpt::poses::CPose3DQuat(n[0], n[1], n[2], quaternion)));
    if (!is_usable_baseline(pose))
        throw std::runtime_error(line.origin +
                                 ": the right camera must stand to the right of the left one, or "
                                 "below it, and look the same way; correct '" +
                                 line.text + "'");
    return pose;
}

/** Takes in a line behind the first one. */
void add_line(const TextLine& line, Calibration& calibration)
{
    const bool has_pose = calibration.baseline_m || calibration.right_pose;
    if (const auto numbers = text_behind("right", line); numbers && !calibration.right)
        calibration.right = parse_camera_model(trim(*numbers), line.origin);
    else if (const auto pose = text_behind("right_pose", line); pose && !has_pose)
        calibration.right_pose = parse_right_pose(trim(*pose), line);
    else if (text_behind("baseline", line) && !has_pose)
        calibration.baseline_m = parse_baseline(line);
    else
        throw std::runtime_error(
            line.origin + ": '" + line.text +
            "' is neither 'baseline METRES', 'right_pose ...' nor 'right ...', once; remove it");
}
}  // namespace

std::optional<RigidTransform> Calibration::left_from_right() const
{
    if (right_pose || !baseline_m) return right_pose;
    return RigidTransform{cv::Matx33d::eye(), {*baseline_m, 0, 0}};
}

Calibration read_calibration_file(const std::string& path)
{
    const auto lines = read_text_lines(path);
    if (lines.empty())
        throw std::runtime_error("no calibration in " + path +
                                 "; write 'fx fy cx cy width height [k1 k2 p1 p2 [k3]]'");
    Calibration calibration;
    calibration.camera = parse_camera_model(lines[0].text, lines[0].origin);
    for (std::size_t i = 1; i < lines.size(); ++i) add_line(lines[i], calibration);
    return calibration;
}

}  // namespace fild
