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

}  // namespace fild
