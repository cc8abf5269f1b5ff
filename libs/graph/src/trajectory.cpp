// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/trajectory.h"

#include "fild/graph/trajectory_frame.h"
#include "fild/graph/uncertain_motion.h"
#include "information.h"
#include "least_covariance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace fild
{
namespace
{
/** later - earlier, whichever of the two comes first. */
Matrix6 growth_between(const Matrix6& a, const Matrix6& b)
{
    const Matrix6 growth = b - a;
    return growth.trace() < 0 ? Matrix6(-growth) : growth;
}

/** Covariance between two absolute poses, along the map's axes: the growth where there is one,
 *  else the sum. */
Matrix6 between_absolute(const Matrix6& a, const Matrix6& b)
{
    constexpr double kShareOfSum = 1e-6;  // rounding
    const Eigen::SelfAdjointEigenSolver<Matrix6> growth(growth_between(a, b));
    Vector6 variances = growth.eigenvalues();
    const Matrix6& axes = growth.eigenvectors();
    for (int i = 0; i < 6; ++i)
    {
        const double both = axes.col(i).dot((a + b) * axes.col(i));
        if (variances(i) <= kShareOfSum * both) variances(i) = both;
    }
    return axes * variances.asDiagonal() * axes.transpose();
}

/** Covariance of the motion from a to b in the tangent at b. */
Matrix6 covariance_between(const UncertainPose& a, const UncertainPose& b)
{
    if (!a.absolute || !b.absolute)
    {
        const Matrix6 to_robot = adjoint(b.map_from_robot.inverse());
        return to_robot * growth_between(a.accumulated, b.accumulated) * to_robot.transpose();
    }
    Matrix6 to_robot = Matrix6::Zero();
    to_robot.topLeftCorner<3, 3>() = b.map_from_robot.rotation.transpose();
    to_robot.bottomRightCorner<3, 3>() = to_robot.topLeftCorner<3, 3>();
    const Matrix6 along_map = a.is_independent && b.is_independent
                                  ? Matrix6(*a.absolute + *b.absolute)
                                  : between_absolute(*a.absolute, *b.absolute);
    return to_robot * along_map * to_robot.transpose();
}
}  // namespace

Trajectory::Trajectory(std::vector<Frame> frames, TrajectoryReport report)
    : frames_(std::move(frames)), report_(std::move(report))
{
    poses_.reserve(frames_.size());
    for (const auto& frame : frames_)
        poses_.push_back(
            {frame.id, frame.timestamp, to_pose(frame.at.map_from_robot), frame.at.segment});
}

Trajectory::Trajectory(const Trajectory& motion, TrajectoryReport report) : Trajectory(motion)
{
    report_ = std::move(report);
}

Trajectory::Trajectory(const Trajectory&) = default;
Trajectory::Trajectory(Trajectory&&) noexcept = default;
Trajectory::~Trajectory() = default;

const Trajectory::Frame* Trajectory::find(FrameId frame) const
{
    const auto found =
        std::lower_bound(frames_.begin(),
                         frames_.end(),
                         frame,
                         [](const Frame& each, FrameId wanted) { return each.id < wanted; });
    return found != frames_.end() && found->id == frame ? &*found : nullptr;
}

std::optional<TrajectoryPose> Trajectory::pose(FrameId frame) const
{
    const auto* found = find(frame);
    if (found == nullptr) return std::nullopt;
    return poses_[static_cast<std::size_t>(found - frames_.data())];
}

std::optional<RelativeMotion> Trajectory::motion(FrameId a, FrameId b) const
{
    const auto* at_a = find(a);
    const auto* at_b = find(b);
    if (at_a == nullptr || at_b == nullptr || at_a->at.segment != at_b->at.segment)
        return std::nullopt;
    const Rigid a_from_b = at_a->at.map_from_robot.inverse() * at_b->at.map_from_robot;
    const Matrix6 covariance = covariance_between(at_a->at, at_b->at) +
                               least_covariance(a_from_b, at_b->at.planar_attitude);
    return to_relative({a_from_b, covariance});
}

Trajectory with_poses(const Trajectory& trajectory, const std::vector<TrajectoryPose>& poses)
{
    auto frames = trajectory.frames();
    const auto& before = trajectory.frames();
    if (poses.size() != frames.size())
        throw std::invalid_argument("with_poses: " + std::to_string(poses.size()) + " poses for " +
                                    std::to_string(frames.size()) + " frames");
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        auto& at = frames[i].at;
        at.map_from_robot = to_rigid(poses[i].map_from_robot);
        const Rigid to_new = at.map_from_robot * before[i].at.map_from_robot.inverse();
        if (at.absolute) at.absolute = turned(*at.absolute, to_new.rotation);
        if (i == 0 || before[i].at.segment != before[i - 1].at.segment)
        {
            at.accumulated.setZero();
            continue;
        }
        const Matrix6 to_map = adjoint(to_new);
        at.accumulated =
            frames[i - 1].at.accumulated +
            to_map * (before[i].at.accumulated - before[i - 1].at.accumulated) * to_map.transpose();
    }
    return {std::move(frames), trajectory.report()};
}

Trajectory trajectory_from_motions(const std::vector<MeasuredMotion>& motions)
{
    TrajectoryReport report;
    report.source = "measured motions";
    report.readings = motions.size();
    std::vector<Trajectory::Frame> frames;
    for (const auto& [a, b, a_timestamp, b_timestamp, motion] : motions)
    {
        const auto edge = "motion from frame " + std::to_string(to_index(a)) + " to frame " +
                          std::to_string(to_index(b));
        if (b <= a || (!frames.empty() && a < frames.back().id))
            throw std::invalid_argument(edge + ": frames must increase");
        require_information(motion.a_from_b, motion.covariance, "covariance of the " + edge);
        auto at = frames.empty() ? UncertainPose() : frames.back().at;
        const bool is_new_segment = !frames.empty() && frames.back().id != a;
        if (is_new_segment) ++at.segment;
        report.resets += is_new_segment ? 1 : 0;
        if (frames.empty() || is_new_segment) frames.push_back({a, a_timestamp, at});
        at.map_from_robot = at.map_from_robot * to_rigid(motion.a_from_b);
        const Matrix6 to_map = adjoint(at.map_from_robot) * tangent_by_parameters(motion.a_from_b);
        at.accumulated += to_map * to_eigen(motion.covariance) * to_map.transpose();
        frames.push_back({b, b_timestamp, at});
    }
    return {std::move(frames), std::move(report)};
}

}  // namespace fild
