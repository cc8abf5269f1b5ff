// SPDX-License-Identifier: BSD-3-Clause
#include "information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr double kRounding = 1e-9;

bool is_finite(const mrpt::poses::CPose3D& pose)
{
    const Rigid rigid = to_rigid(pose);
    return rigid.rotation.allFinite() && rigid.translation.allFinite();
}

/** Units differ: a matrix is judged after its diagonal is scaled to 1. */
bool is_positive_definite(const Matrix6& matrix)
{
    if (!(matrix.diagonal().minCoeff() > 0)) return false;
    const Vector6 scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix6 scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled, Eigen::EigenvaluesOnly);
    constexpr double kSingular = 1e-12;
    return solver.eigenvalues().minCoeff() > kSingular;
}
}  // namespace

void require_information(const mrpt::poses::CPose3D& pose,
                         const mrpt::math::CMatrixDouble66& matrix,
                         const std::string& what)
{
    const Matrix6 m = to_eigen(matrix);
    if (!is_finite(pose)) throw std::invalid_argument(what + ": the pose is not finite");
    if (!m.allFinite()) throw std::invalid_argument(what + ": not finite");
    if ((m - m.transpose()).cwiseAbs().maxCoeff() > kRounding * m.cwiseAbs().maxCoeff())
        throw std::invalid_argument(what + ": not symmetric");
    if (!is_positive_definite(m))
        throw std::invalid_argument(what + ": singular or not positive definite");
}

Matrix6 information_in_tangent(const mrpt::poses::CPose3D& a_from_b,
                               const mrpt::math::CMatrixDouble66& information,
                               const std::string& what)
{
    if (std::abs(std::cos(a_from_b.pitch())) < kRounding)
        throw std::invalid_argument(
            what + ": the pitch is 90 degrees, where yaw and roll cannot be told apart");
    const Matrix6 by_tangent = tangent_by_parameters(a_from_b).inverse();
    const Matrix6 result = by_tangent.transpose() * to_eigen(information) * by_tangent;
    return (result + result.transpose()) / 2;
}

mrpt::math::CMatrixDouble66 inverse_of(const mrpt::math::CMatrixDouble66& matrix)
{
    const Matrix6 inverse = to_eigen(matrix).ldlt().solve(Matrix6::Identity());
    return to_mrpt((inverse + inverse.transpose()) / 2);
}

}  // namespace fild
