// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fild/graph/se3.h"
#include "fild/graph/trajectory.h"

namespace fild
{
/** A motion a_from_b and its covariance in the tangent at its end. Value type. */
struct UncertainMotion
{
    Rigid motion;
    Matrix6 covariance = Matrix6::Zero();
};

/** b_from_a. */
UncertainMotion inverse(const UncertainMotion& a_from_b);

/** a_from_c; the errors are taken as independent, to first order. */
UncertainMotion operator*(const UncertainMotion& a_from_b, const UncertainMotion& b_from_c);

/** Squared Mahalanobis distance of a motion from the identity; chi2 with 6 degrees of freedom. */
double squared_error(const UncertainMotion& cycle);

UncertainMotion to_uncertain(const RelativeMotion& motion);

/** With a covariance of MRPT's parameters, exactly symmetric. */
RelativeMotion to_relative(const UncertainMotion& motion);

}  // namespace fild
