// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/uncertain_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace fild
{
UncertainMotion inverse(const UncertainMotion& a_from_b)
{
    const Matrix6 to_a = adjoint(a_from_b.motion);
    return {a_from_b.motion.inverse(), to_a * a_from_b.covariance * to_a.transpose()};
}

UncertainMotion operator*(const UncertainMotion& a_from_b, const UncertainMotion& b_from_c)
{
    const Matrix6 to_c = adjoint(b_from_c.motion.inverse());
    return {a_from_b.motion * b_from_c.motion,
            to_c * a_from_b.covariance * to_c.transpose() + b_from_c.covariance};
}

double squared_error(const UncertainMotion& cycle)
{
    const Vector6 error = tangent_of(cycle.motion);
    return error.dot(cycle.covariance.ldlt().solve(error));
}

UncertainMotion to_uncertain(const RelativeMotion& motion)
{
    const Matrix6 to_tangent = tangent_by_parameters(motion.a_from_b);
    return {to_rigid(motion.a_from_b),
            to_tangent * to_eigen(motion.covariance) * to_tangent.transpose()};
}

RelativeMotion to_relative(const UncertainMotion& motion)
{
    RelativeMotion result;
    result.a_from_b = to_pose(motion.motion);
    const Matrix6 to_parameters = tangent_by_parameters(result.a_from_b).inverse();
    const Matrix6 covariance = to_parameters * motion.covariance * to_parameters.transpose();
    result.covariance = to_mrpt((covariance + covariance.transpose()) / 2);
    return result;
}

}  // namespace fild
