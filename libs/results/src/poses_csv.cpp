// SPDX-License-Identifier: BSD-3-Clause
#include "fild/results/poses_csv.h"

#include "shared_columns.h"

#include <cmath>
#include <utility>

namespace fild
{
namespace
{
void append_pose(CsvColumns<PoseRow>& columns, const std::string& name, PoseNumbers PoseRow::*pose)
{
    constexpr std::array<const char*, 7> kNumbers = {"x", "y", "z", "qx", "qy", "qz", "qw"};
    for (std::size_t i = 0; i < kNumbers.size(); ++i)
        columns.push_back({name + "_" + kNumbers.at(i),
                           [=](const PoseRow& row) { return shortest_decimal((row.*pose).at(i)); },
                           [=](const CsvField& field, PoseRow& row)
                           { (row.*pose).at(i) = field.number<double>(); }});
}

void normalise_quaternion(PoseNumbers& pose, const std::string& name, const CsvReader& reader)
{
    constexpr double kMaxLengthError = 0.01;
    double squared = 0;
    for (std::size_t i = 3; i < pose.size(); ++i) squared += pose.at(i) * pose.at(i);
    const double length = std::sqrt(squared);
    if (std::abs(length - 1) > kMaxLengthError)
        reader.fail("columns " + name + "_qx to " + name + "_qw are not a unit quaternion");
    for (std::size_t i = 3; i < pose.size(); ++i) pose.at(i) /= length;
}
}  // namespace

CsvColumns<PoseRow> poses_csv_columns()
{
    CsvColumns<PoseRow> columns;
    columns.push_back(frame_column<PoseRow>([](auto& row) -> auto& { return row.frame; }));
    append_pose(columns, "input", &PoseRow::input);
    append_pose(columns, "optimized", &PoseRow::optimized);
    return columns;
}

std::vector<std::optional<PoseRow>> read_poses_csv(const std::string& path, std::size_t frames)
{
    std::vector<std::optional<PoseRow>> poses(frames);
    const auto take = [&](PoseRow row, const CsvReader& reader)
    {
        require_frame(row.frame, frames, reader);
        normalise_quaternion(row.input, "input", reader);
        normalise_quaternion(row.optimized, "optimized", reader);
        poses[to_index(row.frame)] = row;
    };
    read_csv(path, poses_csv_columns(), take);
    return poses;
}

}  // namespace fild
