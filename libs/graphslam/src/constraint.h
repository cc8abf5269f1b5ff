// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/trajectory.h"

#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3DPDFGaussianInf.h>
#include <mrpt/poses/CPosePDFGaussianInf.h>

#include <array>

namespace fild
{
/** A matrix that is symmetric but for rounding, symmetric to the last bit. */
template <class Matrix>
Matrix symmetric(const Matrix& matrix)
{
    Matrix result;
    for (int row = 0; row < matrix.rows(); ++row)
        for (int column = 0; column < matrix.cols(); ++column)
            result(row, column) = (matrix(row, column) + matrix(column, row)) / 2;
    return result;
}

/** Inverse of a covariance. */
template <class Matrix>
Matrix information_of(const Matrix& covariance)
{
    return symmetric(Matrix(covariance.inverse_LLt()));
}

/** A motion as the constraint of a graph's edge. */
inline void set_constraint(const RelativeMotion& motion,
                           mrpt::poses::CPose3DPDFGaussianInf& constraint)
{
    constraint.mean = motion.a_from_b;
    constraint.cov_inv = information_of(motion.covariance);
}

/** What a planar graph sees of a motion: its x, y and yaw, and their covariance, which is not a
 *  part of the information. */
inline void set_constraint(const RelativeMotion& motion,
                           mrpt::poses::CPosePDFGaussianInf& constraint)
{
    constexpr std::array<int, 3> kPlanar = {0, 1, 3};  // of x y z yaw pitch roll
    constraint.mean = mrpt::poses::CPose2D(motion.a_from_b);
    mrpt::math::CMatrixDouble33 covariance;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            covariance(row, column) =
                motion.covariance(kPlanar.at(static_cast<std::size_t>(row)),
                                  kPlanar.at(static_cast<std::size_t>(column)));
    constraint.cov_inv = information_of(covariance);
}

}  // namespace fild
