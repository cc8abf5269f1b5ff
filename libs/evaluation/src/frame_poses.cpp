// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/frame_poses.h"

#include "fild/core/words.h"
#include "number_rows.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace fild
{
namespace
{
/** Files are rounded: one decimal of a quaternion, or of a rotation matrix, leaves as much. */
constexpr double kMaxLengthError = 0.1;  // of a quaternion
constexpr double kMaxRotationError = 0.15;  // of R^T R against the identity

double trace(const cv::Matx33d& m)
{
    return m(0, 0) + m(1, 1) + m(2, 2);
}

/** \return `m` when it is a rotation up to the digits that files usually have, else the rotation
 *  nearest to it; nothing when that is not near, or `m` is a reflection. */
std::optional<cv::Matx33d> nearest_rotation(const cv::Matx33d& m)
{
    constexpr double kExact = 1e-4;
    const double error = cv::norm(m.t() * m - cv::Matx33d::eye());
    if (!(error <= kMaxRotationError) || cv::determinant(m) < 0) return std::nullopt;
    if (error < kExact) return m;
    const cv::SVD svd(m);
    return cv::Matx33d(cv::Mat(svd.u * svd.vt));
}

FramePose parse_kitti(const NumberRow& row)
{
    require_numbers(row, 12, "a 3x4 matrix, row by row");
    const auto& v = row.values;
    FramePose pose;
    pose.rotation = {v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]};
    pose.position = {v[3], v[7], v[11]};
    const auto rotation = nearest_rotation(pose.rotation);
    if (!rotation) throw std::runtime_error(row.origin + ": the left 3x3 numbers are no rotation");
    pose.rotation = *rotation;
    return pose;
}

FramePose parse_tum(const NumberRow& row)
{
    require_numbers(row, 8, "seconds x y z qx qy qz qw");
    cv::Vec4d q(row.values[4], row.values[5], row.values[6], row.values[7]);
    const double length = cv::norm(q);
    if (!(std::abs(length - 1) <= kMaxLengthError))
        throw std::runtime_error(row.origin + ": the last four numbers are no unit quaternion");
    q /= length;
    FramePose pose;
    pose.rotation = rotation_of(q);
    pose.position = {row.values[1], row.values[2], row.values[3]};
    return pose;
}

/** For each frame the row nearest in time, if it is near; else null. With as many rows as frames,
 *  the row of the same number where that is near as well. */
std::vector<const NumberRow*> rows_by_time(const std::vector<NumberRow>& rows,
                                           const std::vector<FrameVerdict>& frames)
{
    std::multimap<double, const NumberRow*> by_time;
    for (const auto& row : rows) by_time.emplace(row.values[0], &row);
    std::vector<const NumberRow*> chosen;
    chosen.reserve(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        const double time = frames[i].timestamp;
        const NumberRow* nearest = nullptr;
        double least = kMaxPoseTimeDifference;
        const auto last = by_time.upper_bound(time + least);
        for (auto row = by_time.lower_bound(time - least); row != last; ++row)
            if (const double difference = std::abs(row->first - time); difference <= least)
            {
                least = difference;
                nearest = row->second;
            }
        const bool has_own = rows.size() == frames.size() &&
                             std::abs(rows[i].values[0] - time) <= kMaxPoseTimeDifference;
        chosen.push_back(has_own ? &rows[i] : nearest);
    }
    return chosen;
}

/** \throw std::runtime_error when the rows are not in the order of their own times. */
void require_order(const std::string& path, const std::vector<NumberRow>& rows)
{
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i].values[0] < rows[i - 1].values[0])
            throw std::runtime_error(rows[i].origin +
                                     ": the time is before that of the line above, and the times " +
                                     "of " + path + " are not those of the frames; is it the " +
                                     "truth of this recording?");
}

double largest_difference(const std::vector<NumberRow>& rows,
                          const std::vector<FrameVerdict>& frames)
{
    double largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        largest = std::max(largest, std::abs(rows[i].values[0] - frames[i].timestamp));
    return largest;
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
        throw std::runtime_error(path + " has poses of " + count_of(rows.size(), "frame") +
                                 ", the run has " + std::to_string(frames.size()) +
                                 "; is it of this recording, and whole?");
    std::vector<PosedFrame> posed;
    posed.reserve(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        posed.push_back({frames[i].timestamp, parse_kitti(rows[i])});
    return posed;
}

TumPoses read_tum_poses(const std::string& path, const std::vector<FrameVerdict>& frames)
{
    const auto rows = read_number_rows(path);
    for (const auto& row : rows) parse_tum(row);  // all must be poses, those of no frame too
    auto chosen = rows_by_time(rows, frames);
    const auto known = static_cast<std::size_t>(
        std::count_if(chosen.begin(), chosen.end(), [](const auto* row) { return row; }));
    TumPoses poses;
    if (rows.size() == frames.size() && 2 * known < frames.size())
    {
        require_order(path, rows);
        poses.seconds_off = largest_difference(rows, frames);
        for (std::size_t i = 0; i < rows.size(); ++i) chosen[i] = &rows[i];
    }
    else if (known == 0)
        throw std::runtime_error("no pose of " + path + " is of the time of a frame; is it the " +
                                 "truth of this recording?");
    poses.frames.reserve(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        poses.frames.push_back({frames[i].timestamp, std::nullopt});
        if (chosen[i] != nullptr) poses.frames.back().pose = parse_tum(*chosen[i]);
    }
    return poses;
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
