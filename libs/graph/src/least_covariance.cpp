// SPDX-License-Identifier: BSD-3-Clause
#include "least_covariance.h"

#include "fild/core/angle.h"

namespace fild
{
namespace
{
double square(double value)
{
    return value * value;
}
}  // namespace

Matrix6 least_covariance(const Rigid& movement, double planar_attitude)
{
    constexpr double kPosition = 0.005;  // m
    constexpr double kAngle = 0.05 * kRadiansPerDegree;
    const double attitude = square(kAngle) + square(planar_attitude);
    // A robot that was tilted saw the way ahead climb or fall.
    const double height = square(kPosition) + square(planar_attitude * movement.translation.norm());
    Vector6 variances;
    variances << square(kPosition), square(kPosition), height, attitude, attitude, square(kAngle);
    return variances.asDiagonal();
}

}  // namespace fild
