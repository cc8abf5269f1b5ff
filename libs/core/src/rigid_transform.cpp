// SPDX-License-Identifier: BSD-3-Clause
#include "fild/core/rigid_transform.h"

#include <algorithm>
#include <cmath>

namespace fild
{
namespace
{
constexpr double kPi = 3.14159265358979323846;

/** The axis of a rotation by nearly pi, where the skew part of the matrix vanishes: the longest
 *  column of (R + I) / 2 = axis axis^T. */
cv::Vec3d axis_of_half_turn(const cv::Matx33d& rotation)
{
    const cv::Matx33d outer = 0.5 * (rotation + rotation.t()) + cv::Matx33d::eye();
    int longest = 0;
    for (int i = 1; i < 3; ++i)
        if (outer(i, i) > outer(longest, longest)) longest = i;
    return cv::normalize(cv::Vec3d(outer(0, longest), outer(1, longest), outer(2, longest)));
}
}  // namespace

cv::Matx33d cross_matrix(const cv::Vec3d& v)
{
    return {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
}

cv::Matx33d rotation_from_vector(const cv::Vec3d& w)
{
    const double angle = cv::norm(w);
    const auto k = cross_matrix(w);
    // Series of sin(a)/a and (1 - cos(a))/a^2 where the quotients lose their digits.
    const bool small = angle < 1e-4;
    const double a = small ? 1 - angle * angle / 6 : std::sin(angle) / angle;
    const double b = small ? 0.5 - angle * angle / 24 : (1 - std::cos(angle)) / (angle * angle);
    return cv::Matx33d::eye() + a * k + b * (k * k);
}

cv::Vec3d vector_from_rotation(const cv::Matx33d& rotation)
{
    const cv::Vec3d skew(0.5 * (rotation(2, 1) - rotation(1, 2)),
                         0.5 * (rotation(0, 2) - rotation(2, 0)),
                         0.5 * (rotation(1, 0) - rotation(0, 1)));
    const double sine = cv::norm(skew);
    const double cosine = std::clamp((cv::trace(rotation) - 1) / 2, -1.0, 1.0);
    const double angle = std::atan2(sine, cosine);
    if (sine > 1e-6) return (angle / sine) * skew;
    if (cosine > 0) return skew;
    const auto axis = axis_of_half_turn(rotation);
    return (axis.dot(skew) < 0 ? -kPi : kPi) * axis;
}

}  // namespace fild
