// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/se3.h"

#include <string>

namespace fild
{
/** \throw std::invalid_argument saying what is wrong with `what`: a pose or matrix with numbers
 * that are not finite, a matrix that is not symmetric, or not positive definite within rounding. */
void require_information(const mrpt::poses::CPose3D& pose,
                         const mrpt::math::CMatrixDouble66& matrix,
                         const std::string& what);

/** Information about MRPT's parameters at a pose as information in the tangent.
 *  \throw std::invalid_argument naming `what` when the pitch is +-90 degrees, where yaw and roll
 * are one. */
Matrix6 information_in_tangent(const mrpt::poses::CPose3D& a_from_b,
                               const mrpt::math::CMatrixDouble66& information,
                               const std::string& what);

/** Inverse of a symmetric positive definite matrix, symmetric itself. */
mrpt::math::CMatrixDouble66 inverse_of(const mrpt::math::CMatrixDouble66& matrix);

}  // namespace fild
