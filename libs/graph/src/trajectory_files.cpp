// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/trajectory_files.h"

#include "fild/core/whole_file.h"
#include "fild/graph/se3.h"
#include "number_text.h"

#include <array>
#include <charconv>
#include <stdexcept>

namespace fild
{
namespace
{
/** Time stamps have all their digits, never an exponent. */
std::string seconds_text(double seconds)
{
    std::array<char, 512> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), seconds, std::chars_format::fixed);
    return {text.data(), end.ptr};
}

std::string tum_line(const TrajectoryPose& pose)
{
    const Rigid rigid = to_rigid(pose.map_from_robot);
    const Eigen::Quaterniond turn(rigid.rotation);
    const auto& t = rigid.translation;
    auto line = seconds_text(pose.timestamp);
    for (const double number : {t.x(), t.y(), t.z(), turn.x(), turn.y(), turn.z(), turn.w()})
        append_number(line, number);
    return line;
}

std::string kitti_line(const TrajectoryPose& pose)
{
    const Rigid rigid = to_rigid(pose.map_from_robot);
    std::string line;
    for (int row = 0; row < 3; ++row)
    {
        for (int column = 0; column < 3; ++column) append_number(line, rigid.rotation(row, column));
        append_number(line, rigid.translation(row));
    }
    return line;
}
}  // namespace

void write_trajectory(const std::string& path,
                      const std::vector<TrajectoryPose>& poses,
                      TrajectoryFormat format)
{
    const bool is_kitti = format == TrajectoryFormat::kitti;
    for (std::size_t i = 0; is_kitti && i < poses.size(); ++i)
        if (to_index(poses[i].frame) != i)
            throw std::runtime_error("cannot write " + path + ": frame " + std::to_string(i) +
                                     " has no pose, and in KITTI's format line i is frame i; set "
                                     "[graph] trajectory_format = tum");
    WholeFile file(path);
    for (const auto& pose : poses)
        file.stream() << (is_kitti ? kitti_line(pose) : tum_line(pose)) << '\n';
    file.commit();
}

}  // namespace fild
