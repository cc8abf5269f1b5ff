// SPDX-License-Identifier: BSD-3-Clause
#include "fild/evaluation/trajectory_error.h"

#include "eigen_poses.h"
#include "fild/core/angle.h"
#include "fild/core/words.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace fild
{
namespace
{
using Poses = std::vector<Eigen::Isometry3d>;

/** Poses of the same times, pair by pair. */
struct PosePairs
{
    Poses estimated;
    Poses truth;
};

Eigen::Isometry3d to_isometry(const FramePose& pose)
{
    Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
    isometry.linear() = to_eigen(pose.rotation);
    isometry.translation() = to_eigen(pose.position);
    return isometry;
}

/** The pose nearest in time, if it is near; `trajectory` in the order of time. */
const TimedPose* nearest_pose(const std::vector<TimedPose>& trajectory, double time)
{
    const auto later = std::lower_bound(trajectory.begin(),
                                        trajectory.end(),
                                        time,
                                        [](const TimedPose& pose, double seconds)
                                        { return pose.timestamp < seconds; });
    const TimedPose* nearest = later == trajectory.end() ? nullptr : &*later;
    if (later != trajectory.begin() &&
        (nearest == nullptr || time - (later - 1)->timestamp < nearest->timestamp - time))
        nearest = &*(later - 1);
    const bool near =
        nearest != nullptr && std::abs(nearest->timestamp - time) <= kMaxPoseTimeDifference;
    return near ? nearest : nullptr;
}

PosePairs pair_by_time(const std::vector<TimedPose>& trajectory,
                       const std::vector<PosedFrame>& truth)
{
    PosePairs pairs;
    for (const auto& frame : truth)
    {
        if (!frame.pose) continue;
        const auto* pose = nearest_pose(trajectory, frame.timestamp);
        if (pose == nullptr) continue;
        pairs.estimated.push_back(to_isometry(pose->pose));
        pairs.truth.push_back(to_isometry(*frame.pose));
    }
    constexpr std::size_t kLeastPairs = 3;
    if (pairs.truth.size() < kLeastPairs)
        throw std::runtime_error(count_of(pairs.truth.size(), "pose is", "poses are") +
                                 " of the time of a true pose, at least 3 must be; is it "
                                 "a trajectory of this recording?");
    return pairs;
}

Eigen::Matrix3Xd positions_of(const Poses& poses)
{
    Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(poses.size()));
    for (std::size_t i = 0; i < poses.size(); ++i)
        positions.col(static_cast<Eigen::Index>(i)) = poses[i].translation();
    return positions;
}

/** Lays the estimated poses over the true ones. */
struct Alignment
{
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
    double scale = 1;

    Eigen::Isometry3d of(const Eigen::Isometry3d& pose) const
    {
        Eigen::Isometry3d aligned = Eigen::Isometry3d::Identity();
        aligned.linear() = rotation * pose.linear();
        aligned.translation() = scale * rotation * pose.translation() + translation;
        return aligned;
    }
};

Alignment alignment_of(const PosePairs& pairs, bool with_scale)
{
    const auto estimated = positions_of(pairs.estimated);
    const Eigen::Vector3d centre = estimated.rowwise().mean();
    const bool moves = (estimated.colwise() - centre).norm() > 0;
    if (with_scale && !moves) throw std::runtime_error("it does not move, so it has no scale");
    const Eigen::Matrix4d truth_from_estimated =
        Eigen::umeyama(estimated, positions_of(pairs.truth), with_scale);
    Alignment alignment;
    alignment.scale = truth_from_estimated.col(0).head<3>().norm();
    alignment.rotation = truth_from_estimated.topLeftCorner<3, 3>() / alignment.scale;
    alignment.translation = truth_from_estimated.topRightCorner<3, 1>();
    return alignment;
}

double rmse_of_positions(const PosePairs& pairs)
{
    return (positions_of(pairs.estimated) - positions_of(pairs.truth)).norm() /
           std::sqrt(static_cast<double>(pairs.truth.size()));
}

/** The constant rotation that brings the axes of the estimated bodies nearest to the true ones. */
Eigen::Matrix3d turn_between_bodies(const PosePairs& pairs)
{
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < pairs.truth.size(); ++i)
        sum += pairs.estimated[i].linear().transpose() * pairs.truth[i].linear();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1, 1, 1);
    signs(2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

/** The rotation, or the one nearest to it that only permutes the axes, when that is near: a robot's
 *  and a camera's axes differ by such a one, and errors of the trajectory then do not count. */
Eigen::Matrix3d snapped_to_axes(const Eigen::Matrix3d& rotation)
{
    constexpr double kNear = 5 * kRadiansPerDegree;
    const Eigen::Matrix3d axes = rotation.array().round();
    const bool is_permutation = (axes * axes.transpose()).isIdentity();
    const bool is_near =
        is_permutation && Eigen::AngleAxisd(axes.transpose() * rotation).angle() < kNear;
    return is_near ? axes : rotation;
}

void align_bodies(PosePairs& pairs)
{
    const Eigen::Matrix3d turn = turn_between_bodies(pairs);
    for (auto& pose : pairs.estimated) pose.linear() = pose.linear() * turn;
}

/** Length of the true way up to each pose. */
std::vector<double> way_lengths(const Poses& truth)
{
    std::vector<double> lengths(truth.size(), 0);
    for (std::size_t i = 1; i < truth.size(); ++i)
        lengths[i] = lengths[i - 1] + (truth[i].translation() - truth[i - 1].translation()).norm();
    return lengths;
}

std::optional<StepError> step_error(const PosePairs& pairs,
                                    const std::vector<double>& way,
                                    double length)
{
    StepError error;
    error.length = length;
    for (std::size_t i = 0; i < way.size(); ++i)
    {
        const auto end = std::lower_bound(way.begin(), way.end(), way[i] + length);
        if (end == way.end()) break;
        const auto j = static_cast<std::size_t>(end - way.begin());
        const Eigen::Isometry3d left = (pairs.truth[i].inverse() * pairs.truth[j]).inverse() *
                                       (pairs.estimated[i].inverse() * pairs.estimated[j]);
        const double angle = Eigen::AngleAxisd(left.rotation()).angle();
        const double step = way[j] - way[i];
        ++error.steps;
        error.translation_rmse += left.translation().squaredNorm();
        error.translation_percent += 100 * left.translation().norm() / step;
        error.rotation_deg_per_m += angle / kRadiansPerDegree / step;
    }
    if (error.steps == 0) return std::nullopt;
    const auto steps = static_cast<double>(error.steps);
    error.translation_rmse = std::sqrt(error.translation_rmse / steps);
    error.translation_percent /= steps;
    error.rotation_deg_per_m /= steps;
    return error;
}
}  // namespace

TrajectoryError trajectory_error(const std::vector<TimedPose>& trajectory,
                                 const std::vector<PosedFrame>& truth,
                                 bool oriented_truth,
                                 const TrajectoryErrorOptions& options)
{
    for (const double length : options.step_lengths)
        if (!(length > 0))
            throw std::invalid_argument("a step length is " + std::to_string(length) +
                                        " m, it must be above 0");
    auto pairs = pair_by_time(trajectory, truth);
    TrajectoryError error;
    error.pairs = pairs.truth.size();
    const auto alignment = alignment_of(pairs, options.align_scale);
    for (auto& pose : pairs.estimated) pose = alignment.of(pose);
    error.scale = alignment.scale;
    error.ate_rmse = rmse_of_positions(pairs);
    if (!oriented_truth) return error;
    align_bodies(pairs);
    const auto way = way_lengths(pairs.truth);
    for (const double length : options.step_lengths)
        if (const auto step = step_error(pairs, way, length)) error.steps.push_back(*step);
    return error;
}

std::vector<PosedFrame> laid_over(const std::vector<TimedPose>& trajectory,
                                  std::vector<PosedFrame> truth)
{
    auto pairs = pair_by_time(trajectory, truth);
    const auto alignment = alignment_of(pairs, false);
    for (auto& pose : pairs.estimated) pose = alignment.of(pose);
    const Eigen::Matrix3d body_from_true_body =
        snapped_to_axes(turn_between_bodies(pairs)).transpose();
    Eigen::Isometry3d truth_from_trajectory = Eigen::Isometry3d::Identity();
    truth_from_trajectory.linear() = alignment.rotation;
    truth_from_trajectory.translation() = alignment.translation;
    const Eigen::Isometry3d trajectory_from_truth = truth_from_trajectory.inverse();
    for (auto& frame : truth)
    {
        if (!frame.pose) continue;
        const Eigen::Isometry3d pose = trajectory_from_truth * to_isometry(*frame.pose);
        const Eigen::Vector3d position = pose.translation();
        frame.pose->rotation = to_opencv(pose.linear() * body_from_true_body);
        frame.pose->position = {position.x(), position.y(), position.z()};
    }
    return truth;
}

}  // namespace fild
