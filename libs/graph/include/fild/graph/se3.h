// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Geometry>

namespace fild
{
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/** A rigid motion a_from_b. Small errors of it are told in b: a_from_b is off by (v, w), metres and
 *  a rotation vector, when it should be a_from_b * (translation v, rotation exp(w)). Covariances
 *  and information matrices "in the tangent" are of that (v, w). */
struct Rigid
{
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();

    Rigid inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
};

inline Rigid operator*(const Rigid& a_from_b, const Rigid& b_from_c)
{
    return {a_from_b.rotation * b_from_c.rotation,
            a_from_b.rotation * b_from_c.translation + a_from_b.translation};
}

Rigid to_rigid(const mrpt::poses::CPose3D& pose);
mrpt::poses::CPose3D to_pose(const Rigid& rigid);

Matrix6 to_eigen(const mrpt::math::CMatrixDouble66& matrix);
mrpt::math::CMatrixDouble66 to_mrpt(const Matrix6& matrix);

/** The error (v, w) of `a_from_b` against the identity: its translation, its rotation vector. */
Vector6 tangent_of(const Rigid& a_from_b);

/** The motion (translation v, rotation exp(w)) of an error: inverse of tangent_of(). */
Rigid rigid_of(const Vector6& tangent);

/** The pose at a share of the way from a to b; below 0 and above 1 as if the robot moved on. */
Rigid between(const Rigid& a, const Rigid& b, double share);

/** A covariance along other axes, for position and rotation vector alike. */
Matrix6 turned(const Matrix6& covariance, const Eigen::Matrix3d& rotation);

/** Takes an error told in b to the same error told in a: for T = a_from_b,
 *  T * error(d) = error(adjoint(T) d) * T, to first order. */
Matrix6 adjoint(const Rigid& a_from_b);

/** Derivative of the tangent error (v, w) by MRPT's parameters (x y z yaw pitch roll) at a pose.
 *  Always finite; singular where pitch is +-90 degrees. */
Matrix6 tangent_by_parameters(const mrpt::poses::CPose3D& pose);

}  // namespace fild
