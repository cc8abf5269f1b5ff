// SPDX-License-Identifier: BSD-3-Clause
#include "wheel_model.h"

#include "fild/core/angle.h"

#include <cmath>

namespace fild
{
namespace
{
double square(double value)
{
    return value * value;
}
}  // namespace

Matrix6 movement_covariance(const TGraphOptions& options, const Rigid& movement, bool is_planar)
{
    constexpr double kReferenceWay = 100;  // m, at which the options tell the drift
    constexpr double kReferenceTurn = 90 * kRadiansPerDegree;
    const double way = movement.translation.norm();
    const double turn = tangent_of(movement).tail<3>().norm();
    // sigma = percent / 100 * reference where the way is the reference
    const double position =
        square(options.drift_percent / 100 * kReferenceWay) * way / kReferenceWay;
    const double heading =
        square(options.heading_drift_deg * kRadiansPerDegree) * way / kReferenceWay +
        square(options.turn_drift_percent / 100 * kReferenceTurn) * turn / kReferenceTurn;
    const double attitude = is_planar ? 0 : heading;
    Vector6 variances;
    variances << position, position, position, attitude, attitude, heading;
    return variances.asDiagonal();
}

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
