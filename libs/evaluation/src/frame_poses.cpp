// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/frame_poses.h"

#include "number_rows.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr double kMaxRotationError = 0.01;  // of R^T R against the identity; files are rounded

double trace(const cv::Matx33d& m)
{
    return m(0, 0) + m(1, 1) + m(2, 2);
}

FramePose parse_kitti(const NumberRow& row)
{
    require_numbers(row, 12, "a 3x4 matrix, row by row");
    const auto& v = row.values;
    FramePose pose;
    pose.rotation = {v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]};
    pose.position = {v[3], v[7], v[11]};
    const auto error = pose.rotation.t() * pose.rotation - cv::Matx33d::eye();
    if (cv::norm(error) > kMaxRotationError)
        throw std::runtime_error(row.origin + ": the left 3x3 numbers are no rotation");
    return pose;
}

FramePose parse_tum(const NumberRow& row)
{
    require_numbers(row, 8, "seconds x y z qx qy qz qw");
    cv::Vec4d q(row.values[4], row.values[5], row.values[6], row.values[7]);
    const double length = cv::norm(q);
    if (std::abs(length - 1) > kMaxRotationError)
        throw std::runtime_error(row.origin + ": the last four numbers are no unit quaternion");
    q /= length;
    FramePose pose;
    pose.rotation = rotation_of(q);
    pose.position = {row.values[1], row.values[2], row.values[3]};
    return pose;
}

/** The row nearest in time, if it is near; `rows` in the order of time. */
const NumberRow* nearest_row(const std::vector<NumberRow>& rows, double timestamp)
{
    const auto later =
        std::lower_bound(rows.begin(),
                         rows.end(),
                         timestamp,
                         [](const NumberRow& row, double time) { return row.values[0] < time; });
    const NumberRow* nearest = nullptr;
    double least = kMaxPoseTimeDifference;
    for (auto row = later == rows.begin() ? later : later - 1; row != rows.end() && row <= later;
         ++row)
        if (const double difference = std::abs(row->values[0] - timestamp); difference <= least)
        {
            least = difference;
            nearest = &*row;
        }
    return nearest;
}
}  // namespace

cv::Matx33d rotation_of(const cv::Vec4d& quaternion)
{
    const double x = quaternion[0];
    const double y = quaternion[1];
    const double z = quaternion[2];
    const double w = quaternion[3];
    return {1 - 2 * (y * y + z * z),
            2 * (x * y - z * w),
            2 * (x * z + y * w),
            2 * (x * y + z * w),
            1 - 2 * (x * x + z * z),
            2 * (y * z - x * w),
            2 * (x * z - y * w),
            2 * (y * z + x * w),
            1 - 2 * (x * x + y * y)};
}

double angle_between(const FramePose& a, const FramePose& b)
{
    const double cosine = (trace(a.rotation.t() * b.rotation) - 1) / 2;
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

std::vector<PosedFrame> read_kitti_poses(const std::string& path,
                                         const std::vector<FrameVerdict>& frames)
{
    const auto rows = read_number_rows(path);
    if (rows.size() != frames.size())
        throw std::runtime_error(path + " has poses of " + std::to_string(rows.size()) +
                                 " frames, the run has " + std::to_string(frames.size()) +
                                 "; is it of this recording, and whole?");
    std::vector<PosedFrame> posed;
    posed.reserve(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        posed.push_back({frames[i].timestamp, parse_kitti(rows[i])});
    return posed;
}

std::vector<PosedFrame> read_tum_poses(const std::string& path,
                                       const std::vector<FrameVerdict>& frames)
{
    auto rows = read_number_rows(path);
    for (const auto& row : rows) parse_tum(row);  // all must be poses, those of no frame too
    const bool line_per_frame = rows.size() == frames.size();
    if (!line_per_frame)
        std::stable_sort(rows.begin(),
                         rows.end(),
                         [](const NumberRow& a, const NumberRow& b)
                         { return a.values[0] < b.values[0]; });
    std::vector<PosedFrame> posed;
    posed.reserve(frames.size());
    bool any = false;
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        posed.push_back({frames[i].timestamp, std::nullopt});
        const auto* row = line_per_frame ? &rows[i] : nearest_row(rows, frames[i].timestamp);
        if (row == nullptr) continue;
        posed.back().pose = parse_tum(*row);
        any = true;
    }
    if (!any)
        throw std::runtime_error("no pose of " + path + " is of the time of a frame; is it the " +
                                 "truth of this recording?");
    return posed;
}

std::vector<TimedPose> read_tum_trajectory(const std::string& path)
{
    const auto rows = read_number_rows(path);
    if (rows.empty()) throw std::runtime_error("no pose in " + path);
    std::vector<TimedPose> trajectory;
    trajectory.reserve(rows.size());
    for (const auto& row : rows) trajectory.push_back({row.values.at(0), parse_tum(row)});
    std::stable_sort(trajectory.begin(),
                     trajectory.end(),
                     [](const TimedPose& a, const TimedPose& b)
                     { return a.timestamp < b.timestamp; });
    return trajectory;
}

}  // namespace fild
