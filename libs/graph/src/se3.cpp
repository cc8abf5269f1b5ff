// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/se3.h"

#include <mrpt/math/CMatrixDynamic.h>

#include <Eigen/Geometry>
#include <cmath>

namespace fild
{
Rigid to_rigid(const mrpt::poses::CPose3D& pose)
{
    const auto& matrix = pose.getRotationMatrix();
    Rigid rigid;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rigid.rotation(row, column) = matrix(row, column);
    rigid.translation = {pose.x(), pose.y(), pose.z()};
    return rigid;
}

mrpt::poses::CPose3D to_pose(const Rigid& rigid)
{
    mrpt::math::CMatrixDouble33 rotation;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rotation(row, column) = rigid.rotation(row, column);
    const auto& t = rigid.translation;
    return {rotation, mrpt::math::CVectorFixedDouble<3>({t.x(), t.y(), t.z()})};
}

Matrix6 to_eigen(const mrpt::math::CMatrixDouble66& matrix)
{
    Matrix6 result;
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column) result(row, column) = matrix(row, column);
    return result;
}

mrpt::math::CMatrixDouble66 to_mrpt(const Matrix6& matrix)
{
    mrpt::math::CMatrixDouble66 result;
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column) result(row, column) = matrix(row, column);
    return result;
}

Vector6 tangent_of(const Rigid& a_from_b)
{
    const Eigen::AngleAxisd turn(a_from_b.rotation);
    Vector6 tangent;
    tangent << a_from_b.translation, turn.angle() * turn.axis();
    return tangent;
}

Rigid rigid_of(const Vector6& tangent)
{
    const Eigen::Vector3d turn = tangent.tail<3>();
    const double angle = turn.norm();
    Rigid rigid;
    rigid.translation = tangent.head<3>();
    if (angle > 0) rigid.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    return rigid;
}

Rigid between(const Rigid& a, const Rigid& b, double share)
{
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(a.rotation).slerp(share, Eigen::Quaterniond(b.rotation));
    return {turn.normalized().toRotationMatrix(),
            a.translation + share * (b.translation - a.translation)};
}

Matrix6 turned(const Matrix6& covariance, const Eigen::Matrix3d& rotation)
{
    Matrix6 turn = Matrix6::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = rotation;
    return turn * covariance * turn.transpose();
}

Matrix6 adjoint(const Rigid& a_from_b)
{
    const auto& t = a_from_b.translation;
    Eigen::Matrix3d cross;
    cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
    Matrix6 result = Matrix6::Zero();
    result.topLeftCorner<3, 3>() = a_from_b.rotation;
    result.topRightCorner<3, 3>() = cross * a_from_b.rotation;
    result.bottomRightCorner<3, 3>() = a_from_b.rotation;
    return result;
}

Matrix6 tangent_by_parameters(const mrpt::poses::CPose3D& pose)
{
    const double sp = std::sin(pose.pitch());
    const double cp = std::cos(pose.pitch());
    const double sr = std::sin(pose.roll());
    const double cr = std::cos(pose.roll());
    Matrix6 result = Matrix6::Zero();
    result.topLeftCorner<3, 3>() = to_rigid(pose).rotation.transpose();
    // Angular velocity in the body's axes, of R = Rz(yaw) Ry(pitch) Rx(roll).
    result.block<3, 1>(3, 3) << -sp, cp * sr, cp * cr;
    result.block<3, 1>(3, 4) << 0, cr, -sr;
    result.block<3, 1>(3, 5) << 1, 0, 0;
    return result;
}

}  // namespace fild
