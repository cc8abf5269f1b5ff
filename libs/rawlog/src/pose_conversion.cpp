// SPDX-License-Identifier: BSD-3-Clause
#include "fild/rawlog/pose_conversion.h"

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussianInf.h>
#include <opencv2/core.hpp>

#include <array>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
using mrpt::poses::CPose3D;

/** A pose as MRPT's densities order it: x, y, z, yaw, pitch, roll. */
std::array<double, 6> coordinates(const CPose3D& pose)
{
    return {pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll()};
}

/** With the i-th error of UncertainTransform moved by `step`. */
RigidTransform disturbed(RigidTransform b_from_a, int i, double step)
{
    if (i < 3)
        b_from_a.translation[i] += step;
    else
    {
        cv::Vec3d w;
        w[i - 3] = step;
        b_from_a.rotation = b_from_a.rotation * rotation_from_vector(w);
    }
    return b_from_a;
}

/** Derivatives of the robot's coordinates by the errors of the camera's pose, by central
 *  differences, which are exact to some 1e-9 here. */
template <class RobotPose>
cv::Matx66d jacobian_of(const RobotPose& robot_pose, const RigidTransform& camera_pose)
{
    constexpr double kStep = 1e-5;
    cv::Matx66d jacobian;
    for (int i = 0; i < 6; ++i)
    {
        const auto above = coordinates(robot_pose(disturbed(camera_pose, i, kStep)));
        const auto below = coordinates(robot_pose(disturbed(camera_pose, i, -kStep)));
        for (std::size_t k = 0; k < above.size(); ++k)
        {
            const double change = above[k] - below[k];  // an angle may pass from pi to -pi
            jacobian(static_cast<int>(k), i) =
                (k < 3 ? change : std::remainder(change, 2 * CV_PI)) / (2 * kStep);
        }
    }
    return jacobian;
}

mrpt::math::CMatrixDouble66 information_from(const cv::Matx66d& covariance)
{
    bool positive_definite = false;
    const cv::Matx66d inverse = covariance.inv(cv::DECOMP_CHOLESKY, &positive_definite);
    if (!positive_definite)
        throw std::invalid_argument("robot_constraint: the covariance is not positive definite");
    mrpt::math::CMatrixDouble66 information;
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            information(row, column) = 0.5 * (inverse(row, column) + inverse(column, row));
    return information;
}
}  // namespace

RigidTransform rigid_transform_from(const CPose3D& pose)
{
    RigidTransform b_from_a;
    const auto& rotation = pose.getRotationMatrix();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            b_from_a.rotation(row, column) = rotation(row, column);
    b_from_a.translation = {pose.x(), pose.y(), pose.z()};
    return b_from_a;
}

CPose3D mrpt_pose_from(const RigidTransform& b_from_a)
{
    mrpt::math::CMatrixDouble33 rotation;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rotation(row, column) = b_from_a.rotation(row, column);
    const auto& t = b_from_a.translation;
    return CPose3D(rotation, mrpt::math::TVector3D(t[0], t[1], t[2]));
}

mrpt::poses::CPose3DPDFGaussianInf robot_constraint(
    const UncertainTransform& candidate_from_query,
    const RigidTransform& candidate_robot_from_camera,
    const RigidTransform& query_robot_from_camera)
{
    const auto query_camera_from_robot = query_robot_from_camera.inverse();
    const auto robot_pose = [&](const RigidTransform& camera_pose)
    { return mrpt_pose_from(candidate_robot_from_camera * camera_pose * query_camera_from_robot); };
    mrpt::poses::CPose3DPDFGaussianInf constraint;
    constraint.mean = robot_pose(candidate_from_query.b_from_a);
    constexpr double kTolerance = 0.01 * CV_PI / 180;
    if (std::abs(std::abs(constraint.mean.pitch()) - CV_PI / 2) < kTolerance)
        throw std::invalid_argument(
            "robot_constraint: with a pitch of 90 degrees yaw, pitch and roll have no covariance");
    const auto jacobian = jacobian_of(robot_pose, candidate_from_query.b_from_a);
    constraint.cov_inv =
        information_from(jacobian * candidate_from_query.covariance * jacobian.t());
    return constraint;
}

}  // namespace fild
